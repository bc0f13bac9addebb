//! Figures of normals and of hidden surfaces.

use super::{agreement, made, value};
use fastphong_cli::lectures::Agreement;

#[test]
fn newells_normals_are_within_rounding_where_edges_fail() {
    let content = made("newell");
    // Corners are off by at most 2⁻²⁵ along each axis. The polygon's radius is 1, or more than ½.
    let bound = (3f64.sqrt() * 4.0 / f64::from(1 << 25)).to_degrees();
    assert!(
        value(&content, "newell") < bound,
        "{} over {bound}",
        value(&content, "newell")
    );
    assert!(value(&content, "area") < 3f64.sqrt() * 8.0 / f64::from(1 << 25));
    // The cross product of two edges of length 1 is off by a few roundings of 2⁻²⁴.
    assert!(value(&content, "hexagon") < 10.0 * bound);
    // L21 1.1: edges of 1e-6 are 17 units of 2⁻²⁴ long, which turns the normal by degrees.
    // Collinear edges have no normal.
    for key in ["short", "collinear", "nearly"] {
        assert!(
            value(&content, key) > 1.0,
            "{key}: {}",
            value(&content, key)
        );
        assert_eq!(agreement(&content, key), Agreement::Confirms);
    }
    // T17: the sign.
    assert!(value(&content, "reflex") > 179.9);
}

#[test]
fn normals_are_averages_and_shorten_in_between() {
    let content = made("normals");
    assert_eq!(agreement(&content, "averaged"), Agreement::Confirms);
    // Averages have errors of at least first order in a polygon's size, which is halved twice.
    assert!(value(&content, "finer") > 4.0);
    // Polygons around a torus vertex lie in pairs, whose errors cancel except for a higher order.
    assert!(value(&content, "regular") < 0.05 * value(&content, "averaged"));
    // 32 steps round by 3 half units each, and the rounded ends add as much. The root of at least
    // 1/4 doubles it.
    assert!(value(&content, "half-way") < 2.0 * (3.0 * 32.0 + 8.0) / f64::from(1 << 24));
    // Cells are 45° by 30°: the middle of one loses at most 1 − cos 22.5° cos 15°, and most of it
    // next to the equator.
    let largest = 100.0 * (1.0 - 22.5f64.to_radians().cos() * 15.0f64.to_radians().cos());
    let darkened = value(&content, "darkened");
    assert!(
        (0.5 * largest..=largest + 0.1).contains(&darkened),
        "{darkened} of {largest}"
    );
}

#[test]
fn diagonals_move_normals_but_not_by_angle() {
    let content = made("diagonal");
    // At a corner, one face has two triangles and each other face has one: (2, 1, 1) in place of
    // (1, 1, 1). Normals are rounded to f32.
    let moved = (4.0 / 18f64.sqrt()).acos().to_degrees();
    let rounding = f64::from(f32::EPSILON).to_degrees();
    for (key, expected) in [
        ("uniform", moved),
        ("area", moved),
        ("angle", 0.0),
        ("max", 0.0),
    ] {
        let found = value(&content, key);
        assert!((found - expected).abs() < rounding, "{key}: {found}");
        let seen = value(&content, &format!("{key}-levels"));
        assert_eq!(seen > 1.0, expected > 0.0, "{key}: {seen}");
    }
    // The sum π/2 (x + (x + y)/√2 + (x + z)/√2) + π/3 (x + y + z)/√3 is compared with x.
    let (half, third) = (std::f64::consts::FRAC_PI_2, std::f64::consts::PI / 3.0);
    let across = half / 2f64.sqrt() + third / 3f64.sqrt();
    let along = half + 2.0 * half / 2f64.sqrt() + third / 3f64.sqrt();
    let expected = (2f64.sqrt() * across / along).atan().to_degrees();
    // Positions have one decimal digit and are rounded to f32. Edges are 0.2 long.
    let bound = (8.0 / f64::from(1 << 24) / 0.2).to_degrees();
    assert!((value(&content, "bevelled") - expected).abs() < bound);
    assert!(value(&content, "smooth-angle") < value(&content, "smooth"));
}

#[test]
fn normals_need_the_inverse_transpose() {
    let content = made("inverse-transpose");
    // The error is largest at 45° of the circle: tan⁻¹ s − tan⁻¹ 1/s.
    let s = 2.5f64;
    let largest = (s.atan() - (1.0 / s).atan()).to_degrees();
    assert!((value(&content, "matrix") - largest).abs() < 1e-9);
    assert!(value(&content, "inverse-transpose") < 1e-6);
    assert!(value(&content, "engine") < value(&content, "picture") / 4.0);
    assert_eq!(agreement(&content, "picture"), Agreement::Confirms);
}

#[test]
fn no_order_draws_rings_and_cutting_polygons_right() {
    let content = made("painter");
    for key in ["ring-wrong", "ring-best-order", "cutting-wrong"] {
        assert!(
            value(&content, key) > 50.0,
            "{key}: {}",
            value(&content, key)
        );
    }
    assert_eq!(value(&content, "ring-cycle"), 3.0);
    // Each of three polygons meets the two others.
    assert_eq!(value(&content, "cutting-pairs"), 3.0);
    assert_eq!(
        value(&content, "order"),
        0.0,
        "no two polygons have equal depth at a pixel"
    );
}

#[test]
fn depth_levels_and_values_are_those_of_theory() {
    let content = made("depth");
    assert!(
        value(&content, "fighting-16") > 100.0,
        "{}",
        value(&content, "fighting-16")
    );
    assert_eq!(value(&content, "fighting-24"), 0.0);
    assert_eq!(agreement(&content, "ways"), Agreement::Confirms);
    assert!(
        value(&content, "ways") > 0.0,
        "two ways that are one way show nothing"
    );
    // z(2n) in 0..1 is f/(f − n) · (1 − n/2n) = f/(2 (f − n)), and f is 500 n.
    assert!((value(&content, "half") - 0.5 * 500.0 / 499.0).abs() < 1e-12);
    // z(f/2) = f/(f − n) (1 − 2n/f) = 498/499, and half-way is (f/2 − n)/(f − n) = 249/499. In
    // −1..1 it is twice that.
    assert!((value(&content, "preserved") - 2.0 * 249.0 / 499.0).abs() < 1e-12);
}

#[test]
fn supersampling_approaches_the_covered_share() {
    let content = made("supersampling");
    // One sample gives 0 or 1 for evenly spread shares: an error of at least √(1/12) = 0.29. With
    // n × n samples only the edge within a row of samples is off, by less than 1/n of it.
    assert!(
        value(&content, "share") > 8.0,
        "{}",
        value(&content, "share")
    );
    assert_eq!(agreement(&content, "share"), Agreement::Confirms);
    assert_eq!(value(&content, "linear"), 188.0, "the sRGB level of ½");
}
