//! The normal of a polygon from two of its edges, and by Newell's formula (L21 1.1).

use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::mesh::newell::newell;
use crate::picture::Picture8;
use crate::shader::Variant;
use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

pub(super) static FIGURE: Figure = Figure {
    name: "newell",
    title: "The normal of a polygon: from two edges, and by Newell's formula",
    lecture: "L21 1.1, eq 1.1",
    make,
};

/// A polygon in the plane z = 0, counter-clockwise, whose first three corners are what the two-edge normal uses.
struct Case {
    name: &'static str,
    what: &'static str,
    corners: Vec<[f32; 2]>,
}

fn cases() -> Vec<Case> {
    let case = |name, what, corners: &[[f32; 2]]| Case { name, what, corners: corners.to_vec() };
    vec![
        case(
            "regular",
            "a regular hexagon",
            &[[1.0, 0.0], [0.5, 0.866], [-0.5, 0.866], [-1.0, 0.0], [-0.5, -0.866], [0.5, -0.866]],
        ),
        case(
            "short",
            "a first edge of 2·10⁻⁶",
            &[[0.9, -0.9], [0.900002, -0.9], [0.9, 0.9], [-0.9, 0.9], [-0.9, -0.9]],
        ),
        case(
            "nearly-collinear",
            "first corners within 10⁻⁶ of a line",
            &[[-0.9, -0.9], [0.0, -0.900001], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        ),
        case(
            "collinear",
            "first corners on a line",
            &[[-0.9, -0.9], [0.0, -0.9], [0.9, -0.9], [0.9, 0.9], [-0.9, 0.9]],
        ),
        case("reflex", "a first corner that turns inward", &[[-0.9, -0.9], [0.0, 0.5], [0.9, -0.9], [0.0, 0.9]]),
    ]
}

/// The axes of the plane in which the polygons lie: unit vectors without zeros, so that rounding moves corners out of it.
const AXES: [DVec3; 2] = [DVec3::new(2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0), DVec3::new(6.0 / 7.0, 2.0 / 7.0, -3.0 / 7.0)];

/// A corner in space, rounded to f32 as a mesh has it: so far from the origin that this can be seen.
fn lifted(corner: [f32; 2]) -> DVec3 {
    let [u, v] = AXES;
    let origin = DVec3::new(10.0, -20.0, 30.0);
    (origin + u * f64::from(corner[0]) + v * f64::from(corner[1])).as_vec3().as_dvec3()
}

/// The true normal of that plane.
fn truth() -> DVec3 {
    AXES[0].cross(AXES[1])
}

/// The normal from two adjacent edges, before it is normalised:
/// ```text
/// N = (P_{i+1} − P_i) × (P_{i+2} − P_{i+1})      (L21 1.1)
/// ```
fn two_edges(p: &[DVec3]) -> DVec3 {
    (p[1] - p[0]).cross(p[2] - p[1])
}

/// The angle between a normal and the true one in degrees; `None` where it has no direction.
fn angle(normal: DVec3) -> Option<f64> {
    let unit = normal.try_normalize()?;
    Some(libm::atan2(unit.cross(truth()).length(), unit.dot(truth())).to_degrees())
}

/// The polygon seen from above, flat, with the normal that was found for it: a normal that is right is bright, one that
/// looks away or is none at all is dark.
fn picture(case: &Case, found: DVec3) -> Result<Picture8, FigureError> {
    // The frame's z is the plane's normal; light comes from there, a little from the side.
    let toward = |v: DVec3| DVec3::new(v.dot(AXES[0]), v.dot(AXES[1]), v.dot(truth()));
    let place = |c: &[f32; 2]| [44.0 + 40.0 * f64::from(c[0]), 36.0 - 34.0 * f64::from(c[1])];
    let normal = toward(found.normalize_or_zero());
    let corners: Vec<Corner> = case.corners.iter().map(|c| Corner::new(place(c), DVec3::Z)).collect();
    let grey = Grey { ambient: 0.15, diffuse: 0.8, ..Grey::dull(DVec3::Z) };
    let facet = Facet { corners, normal };
    Ok(stored(&Variant::parse("flat")?.render_linear(&frame([88, 72], &grey, &[facet])?)))
}

/// Twice the area of a polygon of the plane, by its corners' coordinates in double precision.
fn doubled_area(corners: &[[f32; 2]]) -> f64 {
    let wide = |c: [f32; 2]| (f64::from(c[0]), f64::from(c[1]));
    let following = corners.iter().cycle().skip(1);
    let term = |(a, b): (&[f32; 2], &[f32; 2])| {
        let ((ax, ay), (bx, by)) = (wide(*a), wide(*b));
        ax * by - bx * ay
    };
    corners.iter().zip(following).map(term).sum()
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "Five polygons in one plane, their corners rounded to f32. The normal is computed from the first two edges, and by \
         Newell's formula from all corners; each polygon is then shaded flat with the normal found. Bright is right.",
    );
    let (mut shown, mut rows, mut area_error) = (Vec::new(), Vec::new(), 0.0f64);
    let (mut worst_two, mut worst_newell) = (0.0f64, 0.0f64);
    for case in cases() {
        let corners: Vec<DVec3> = case.corners.iter().map(|c| lifted(*c)).collect();
        let (two, all) = (two_edges(&corners), newell(corners.iter().copied()));
        let (of_two, of_all) = (angle(two), angle(all));
        let words = |angle: Option<f64>| angle.map_or("no direction".into(), |a| format!("{}°", written(a)));
        rows.push(vec![String::from(case.what), words(of_two), words(of_all)]);
        shown.push(Shown::new(
            format!("{}: {}", case.name, words(of_two)),
            format!("{}, two-edge normal.", case.what),
            picture(&case, two)?,
        ));
        shown.push(Shown::new(
            format!("Newell: {}", words(of_all)),
            format!("{}, Newell's normal.", case.what),
            picture(&case, all)?,
        ));
        // No direction is as wrong as the opposite one.
        worst_newell = worst_newell.max(of_all.unwrap_or(180.0));
        worst_two = worst_two.max(of_two.unwrap_or(180.0));
        area_error = area_error.max((all.length() / doubled_area(&case.corners) - 1.0).abs());
        content.found(Finding::new(
            format!("two-edges-{}", case.name),
            format!("angle of the two-edge normal to the true one: {}", case.what),
            (of_two.unwrap_or(180.0), "degrees"),
            Agreement::if_holds((of_two.unwrap_or(180.0) > 1.0) == (case.name != "regular")),
            if of_two.is_some_and(|a| a < 1.0) {
                "The two-edge normal is right."
            } else {
                "The two-edge normal fails."
            },
        ));
    }
    content.pictures(4, shown);
    content.table(&["polygon", "two edges", "Newell"], rows);
    content.found(Finding::new(
        "newell",
        "largest angle of Newell's normal to the true one",
        (worst_newell, "degrees"),
        Agreement::if_holds(worst_newell < 0.001),
        if worst_newell < 0.001 { "Newell's formula is right for all of them." } else { "Newell's formula fails too." },
    ));
    content.found(Finding::new(
        "area",
        "largest relative difference of |N| from twice the area",
        (area_error, ""),
        Agreement::if_holds(area_error < 1e-5),
        if area_error < 1e-5 { "|N| = 2 Area, rounding of the corners aside." } else { "|N| is not 2 Area." },
    ));
    if let Some(reflex) = content.finding("two-edges-reflex").map(|finding| finding.value) {
        content.found(Finding::new(
            "reflex",
            "angle of the two-edge normal at a corner that turns inward",
            (reflex, "degrees"),
            Agreement::Adds,
            if reflex > 170.0 {
                "It points the other way: the lecture does not mention this failure."
            } else {
                "It does not flip."
            },
        ));
    }
    Ok(content)
}
