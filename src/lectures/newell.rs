//! The normal of a polygon from two edges, and by Newell's formula (L21 1.1).

use super::stage::{Corner, Facet, Grey, frame, stored, written};
use super::{Agreement, Content, Figure, FigureError, Finding, Shown};
use crate::mesh::newell::newell;
use crate::shading::Variant;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::vec::Vec;
use glam::{DQuat, DVec2, DVec3, Vec3};

pub(super) static FIGURE: Figure = Figure {
    name: "newell",
    title: "Newell\u{2019}s formula, and the normal from two edges",
    lecture: "L21 1.1: (1.1), |N| = 2 Area",
    make,
};

/// A polygon in its plane, counter-clockwise, and why the normal from two edges fails there.
struct Example {
    key: &'static str,
    what: &'static str,
    corners: Vec<DVec2>,
    /// True if the lecture names the case.
    is_named: bool,
}

/// The regular hexagon of radius 1.
fn hexagon() -> Vec<DVec2> {
    (0..6)
        .map(|k| DVec2::from_angle(f64::from(k) * core::f64::consts::FRAC_PI_3))
        .collect()
}

/// A hexagon with one more corner between the first two: at this part of their edge, and so far outside of it.
fn with_corner(part: f64, outside: f64) -> Vec<DVec2> {
    let mut corners = hexagon();
    let edge = corners[1] - corners[0];
    let outward = -edge.perp().normalize();
    corners.insert(1, corners[0] + part * edge + outside * outward);
    corners
}

fn examples() -> [Example; 5] {
    let reflex = [(-1.0, -0.8), (0.0, -0.2), (1.0, -0.8), (0.0, 1.0)].map(DVec2::from);
    [
        Example {
            key: "hexagon",
            what: "regular hexagon",
            corners: hexagon(),
            is_named: true,
        },
        Example {
            key: "short",
            what: "an edge of 10⁻⁶",
            corners: with_corner(1e-6, 2e-7),
            is_named: true,
        },
        Example {
            key: "collinear",
            what: "three collinear vertices",
            corners: with_corner(0.5, 0.0),
            is_named: true,
        },
        Example {
            key: "nearly",
            what: "three nearly collinear vertices",
            corners: with_corner(0.5, 1e-7),
            is_named: true,
        },
        Example {
            key: "reflex",
            what: "a reflex corner",
            corners: reflex.into(),
            is_named: false,
        },
    ]
}

/// The tilt of all polygons, so that no coordinate is a round number: toward +z with x and y of their own.
fn tilt() -> DQuat {
    DQuat::from_rotation_arc(DVec3::Z, DVec3::new(0.31, 0.47, 0.83).normalize())
}

/// The corners in space, rounded as a mesh stores them.
fn placed(example: &Example) -> Vec<Vec3> {
    let tilt = tilt();
    example
        .corners
        .iter()
        .map(|corner| (tilt * corner.extend(0.0)).as_vec3())
        .collect()
}

/// (P_{i+1} − P_i) × (P_{i+2} − P_{i+1}), in `f32` as the corners are; zero may come out.
fn two_edges(corners: &[Vec3], i: usize) -> DVec3 {
    let at = |k: usize| corners[(i + k) % corners.len()];
    (at(1) - at(0)).cross(at(2) - at(1)).as_dvec3()
}

fn by_newell(corners: &[Vec3]) -> DVec3 {
    newell(corners.iter().map(|corner| corner.as_dvec3()))
}

/// The angle from the true normal in degrees; `None` for a vector without a direction.
fn error(normal: DVec3) -> Option<f64> {
    let truth = tilt() * DVec3::Z;
    let unit = normal / normal.length();
    unit.is_finite()
        .then(|| 2.0 * libm::atan2((unit - truth).length(), (unit + truth).length()).to_degrees())
}

/// Twice the area in the plane, by the shoelace formula.
fn twice_the_area(corners: &[DVec2]) -> f64 {
    (0..corners.len())
        .map(|k| corners[k].perp_dot(corners[(k + 1) % corners.len()]))
        .sum()
}

/// The corner at which the normal from two edges is worst, with that normal: one without a direction is the worst.
fn worst(corners: &[Vec3]) -> DVec3 {
    let badness = |normal: &DVec3| error(*normal).unwrap_or(f64::INFINITY);
    let all = (0..corners.len()).map(|i| two_edges(corners, i));
    all.max_by(|a, b| badness(a).total_cmp(&badness(b)))
        .unwrap_or(DVec3::ZERO)
}

fn make() -> Result<Content, FigureError> {
    let mut content = Content::default();
    content.text(
        "The same plane for all polygons, tilted, with corners rounded to f32. The normal from two edges is taken at its \
         worst corner: any corner may be the first one that a file names. Newell's formula takes the sum over all.",
    );
    pictures(&mut content)?;
    let mut rows = Vec::new();
    let mut largest: f64 = 0.0;
    let mut area: f64 = 0.0;
    for example in &examples() {
        let corners = placed(example);
        let (edges, sum) = (worst(&corners), by_newell(&corners));
        let good = (0..corners.len())
            .filter_map(|i| error(two_edges(&corners, i)))
            .fold(f64::INFINITY, f64::min);
        let twice = twice_the_area(&example.corners);
        let off = (sum.length() / twice - 1.0).abs();
        area = area.max(off);
        largest = largest.max(error(sum).unwrap_or(180.0));
        let degrees = |error: Option<f64>| {
            error.map_or(String::from("no direction"), |e| format!("{}°", written(e)))
        };
        rows.push(Vec::from([
            example.what.to_string(),
            degrees(Some(good)),
            degrees(error(edges)),
            degrees(error(sum)),
            format!("{:.7}", sum.length()),
            format!("{twice:.7}"),
        ]));
        failure(&mut content, example, error(edges));
    }
    content.table(
        &[
            "polygon",
            "two edges: best corner",
            "worst corner",
            "Newell",
            "|N|",
            "2 Area",
        ],
        rows,
    );
    content.claim(
        "newell",
        "Newell's formula: largest error over all polygons",
        (largest, "degrees"),
        largest < 1e-4,
        [
            "Rounding of the corners, and no more.",
            "More than rounding of the corners.",
        ],
    );
    content.claim(
        "area",
        "|N| against 2 Area: largest relative difference",
        (area, ""),
        area < 1e-6,
        ["|N| = 2 Area, rounding aside.", "|N| is not 2 Area."],
    );
    Ok(content)
}

fn failure(content: &mut Content, example: &Example, error: Option<f64>) {
    // Where there is no direction, any may be taken: the opposite one at worst.
    let degrees = error.unwrap_or(180.0);
    let fails = degrees > 1.0;
    let verdict = match error {
        None => "The two edges have no normal: their cross product is zero.",
        Some(e) if e > 90.0 => {
            "It points to the other side: the polygon would be culled, or lit from behind."
        }
        Some(_) if fails => "Visibly wrong.",
        Some(_) => "Good where nothing is degenerate.",
    };
    let agreement = match (example.is_named, example.key) {
        (true, "hexagon") => Agreement::if_holds(!fails),
        (true, _) => Agreement::if_holds(fails),
        (false, _) => Agreement::Adds,
    };
    content.found(Finding::new(
        example.key,
        format!(
            "two edges at the worst corner, {}: error (180 if there is no direction)",
            example.what
        ),
        (degrees, "degrees"),
        agreement,
        verdict,
    ));
}

/// All polygons side by side, lit by the one normal and by the other.
fn pictures(content: &mut Content) -> Result<(), FigureError> {
    // Far from the normal, so that a few degrees are seen.
    let light = DVec3::new(-0.6, 0.3, 0.7);
    let grey = Grey {
        ambient: 0.08,
        diffuse: 0.9,
        ..Grey::dull(light)
    };
    let draw = |normal: &dyn Fn(&[Vec3]) -> DVec3| {
        let facets: Vec<Facet> = examples()
            .iter()
            .enumerate()
            .map(|(i, example)| {
                let middle = DVec2::new(24.0 + 48.0 * i as f64, 24.0);
                let place =
                    |corner: &DVec2| [middle.x + 21.0 * corner.x, middle.y - 21.0 * corner.y];
                let corners: Vec<Corner> = example
                    .corners
                    .iter()
                    .map(|c| Corner::new(place(c), DVec3::Z))
                    .collect();
                let normal = normal(&placed(example));
                // No direction: no light but the ambient one.
                Facet {
                    corners,
                    normal: normal.try_normalize().unwrap_or(DVec3::ZERO),
                }
            })
            .collect();
        Ok::<_, FigureError>(stored(&Variant::parse("flat")?.render_linear(&frame(
            [240, 48],
            &grey,
            &facets,
        )?)))
    };
    let names: Vec<&str> = examples().iter().map(|example| example.what).collect();
    let names = names.join(", ");
    content.pictures(
        1,
        Vec::from([
            Shown::new(
                format!("lit by the normal from two edges, at its worst corner: {names}"),
                "Five polygons of one plane; four of them are dark or of another grey than the first.",
                draw(&worst)?,
            ),
            Shown::new(
                "lit by the normal of Newell\u{2019}s formula",
                "The same polygons, all of one grey.",
                draw(&by_newell)?,
            ),
        ]),
    );
    Ok(())
}
