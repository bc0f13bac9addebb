//! Checks the methods that interpolate angles, or in another chart of the sphere, against their own
//! formulas, evaluated in `f64` one pixel at a time. Also checks the related methods that light
//! Phong's normals differently.

use super::lecture::{
    AMBIENT, DIFFUSE, LIGHT, SHININESS, SPECULAR, TOLERANCE, VIEW, WIDTH, intensity, lighting,
    pairs, strip_lit,
};
use fastphong::scene::SpecularModel;
use fastphong::shading::Variant;
use glam::{DQuat, DVec3};

/// Draws strips by a method with one kind of highlight, and compares their pixels with a formula of
/// both normals and t.
#[track_caller]
fn check(
    specular: SpecularModel,
    variant: &str,
    tolerance: f64,
    formula: impl Fn(DVec3, DVec3, f64) -> f64,
) {
    let variant = Variant::parse(variant).expect("a method");
    for (n1, n2) in pairs() {
        let mut lighting = lighting();
        lighting.specular = specular;
        let picture = variant
            .render_linear(&strip_lit(lighting, n1, n2))
            .expect("a method for the frame");
        for row in 0..4 {
            for (column, pixel) in picture.row(row).iter().enumerate() {
                let t = (column as f64 + 0.5) / f64::from(WIDTH);
                let (found, expected) = (f64::from(pixel[0]), formula(n1, n2, t).min(1.0));
                assert!(
                    (found - expected).abs() < tolerance,
                    "{variant} at {column}, {row}: {found} instead of {expected}"
                );
            }
        }
    }
}

/// Evaluates (2.1) as printed, from a normal.
fn lit(n: DVec3) -> f64 {
    let r = 2.0 * LIGHT.dot(n) * n - LIGHT;
    intensity(LIGHT.dot(n), r.dot(VIEW))
}

/// Evaluates (4.7).
fn slerp(n1: DVec3, n2: DVec3, t: f64) -> DVec3 {
    let phi = n1.angle_between(n2);
    (((1.0 - t) * phi).sin() * n1 + (t * phi).sin() * n2) / phi.sin()
}

/// Evaluates (2.1) with N·H, from a unit normal.
fn lit_half(n: DVec3) -> f64 {
    intensity(LIGHT.dot(n), n.dot((LIGHT + VIEW).normalize()))
}

/// Returns Phong's normal.
fn lerp(n1: DVec3, n2: DVec3, t: f64) -> DVec3 {
    n1.lerp(n2, t).normalize()
}

/// Turning all vectors into the eye's frame does not change Phong's picture.
#[test]
fn phong_in_the_frame_of_the_eye_is_phong() {
    check(
        SpecularModel::Phong,
        "eye-frame-phong",
        TOLERANCE,
        |n1, n2, t| lit(lerp(n1, n2, t)),
    );
}

/// Forward differences of N·H give N·H at every pixel.
#[test]
fn duff_with_half_vectors_is_phong_with_half_vectors() {
    let formula = |n1, n2, t| lit_half(lerp(n1, n2, t));
    check(SpecularModel::Blinn, "duff-half", TOLERANCE, formula);
}

/// The method follows N·H along the great circle (4.7).
#[test]
fn slerp_with_half_vectors_follows_the_great_circle() {
    let formula = |n1, n2, t| lit_half(slerp(n1, n2, t));
    check(SpecularModel::Blinn, "slerp-half", TOLERANCE, formula);
}

/// CS171, Algorithm 7, as printed: the interpolated normal is lit without normalising it.
#[test]
fn unnormalised_phong_lights_short_normals() {
    check(
        SpecularModel::Phong,
        "phong-unnormalised",
        TOLERANCE,
        |n1, n2, t| lit(n1.lerp(n2, t)),
    );
}

/// A point of the stereographic chart is interpolated. Its walk steps two values, and N moves twice
/// as far.
#[test]
fn stereographic_phong_interpolates_points_of_the_chart() {
    let formula = |n1: DVec3, n2: DVec3, t: f64| {
        let point = |n: DVec3| n.truncate() / (1.0 + n.z);
        let u = point(n1).lerp(point(n2), t);
        let square = u.length_squared();
        lit((2.0 * u).extend(1.0 - square) / (1.0 + square))
    };
    check(
        SpecularModel::Phong,
        "stereographic-phong",
        2.0 * TOLERANCE,
        formula,
    );
}

/// Quaternions of the least turns from the eye's direction are interpolated, and turn that
/// direction into the normal. N turns twice as far as they do.
#[test]
fn quaternion_phong_interpolates_turns() {
    let formula = |n1: DVec3, n2: DVec3, t: f64| {
        let turn = |n| DQuat::from_rotation_arc(DVec3::Z, n);
        let (q1, q2) = (turn(n1), turn(n2));
        lit((q1 * (1.0 - t) + q2 * t).normalize() * DVec3::Z)
    };
    check(
        SpecularModel::Phong,
        "quaternion-phong",
        2.0 * TOLERANCE,
        formula,
    );
}

/// Half-reflection turns by twice the angle between a line and the bisector, and each turn doubles
/// errors.
#[test]
fn half_reflection_reflects_the_first_normal() {
    let formula = |n1: DVec3, n2: DVec3, t: f64| {
        let half = n1.dot(n2).acos() / 2.0;
        let angle = 2.0 * (t * half.sin()).atan2(1.0 - t + t * half.cos());
        lit(slerp(n1, n2, angle / (2.0 * half)))
    };
    check(
        SpecularModel::Phong,
        "half-reflection",
        2.0 * TOLERANCE,
        formula,
    );
}

/// A Phong map interpolates x and y. Errors of x and y are divided by z, which is at least 0.34
/// here.
#[test]
fn phong_maps_interpolate_x_and_y() {
    let formula = |n1: DVec3, n2: DVec3, t: f64| {
        let n = n1.lerp(n2, t);
        lit(n
            .truncate()
            .extend((1.0 - n.truncate().length_squared()).sqrt()))
    };
    check(SpecularModel::Phong, "phong-map", 3.0 * TOLERANCE, formula);
}

/// Kuijk and Blake's angles are those of the great circle. Their parabolas differ from the power of
/// the cosine by 0.015 at exponent 20.
#[test]
fn kuijk_and_blake_follow_angles() {
    let formula = |n1: DVec3, n2: DVec3, t: f64| {
        let n = SHININESS as f64;
        let (a, b) = (
            (n + 5.6) / (n * (0.09 * n + 5.2)),
            (n + 65.0) / (5.0 * n + 31.7),
        );
        let here = slerp(n1, n2, t);
        // Project H into the plane of the great circle.
        let across = n1.cross(n2).normalize();
        let h = (LIGHT + VIEW).normalize();
        let h = h - h.dot(across) * across;
        let angle = h.angle_between(here);
        let power = if angle < a {
            1.0 - angle * angle / (a * b)
        } else if angle < b {
            (angle - b) * (angle - b) / (b * (b - a))
        } else {
            0.0
        };
        let l_n = LIGHT.dot(here);
        let specular = if l_n > 0.0 {
            SPECULAR * h.length().powi(SHININESS) * power
        } else {
            0.0
        };
        AMBIENT + DIFFUSE * l_n.max(0.0) + specular
    };
    check(SpecularModel::Blinn, "kuijk-blake", TOLERANCE, formula);
    // Compared with the power itself, not with the method's own constants.
    let powers = |n1, n2, t| lit_half(slerp(n1, n2, t));
    check(
        SpecularModel::Blinn,
        "kuijk-blake",
        0.015 * SPECULAR,
        powers,
    );
}
