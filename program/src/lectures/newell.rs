//! The normal of a polygon from two edges, and by Newell's formula (L21 1.1).

use super::prelude::*;
use fastphong::mesh::newell::newell;
use glam::{DQuat, Vec3};

pub(super) static FIGURE: Figure = Figure {
    name: "newell",
    title: "Newell\u{2019}s formula, and the normal from two edges",
    lecture: "L21 1.1: (1.1), |N| = 2 Area",
    parts: &[pictures, errors],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "N = ½ Σ (Pᵢ − Pᵢ₊₁) × (Pᵢ + Pᵢ₊₁) sums over all edges. Two edges are enough only if no corner is flat or reflex (L21 1.1).",
    handles: &[
        Handle::coordinate(["x1", "corner 1, right"], 'x', [-1.0, 1.0], -0.9375),
        Handle::coordinate(["y1", "corner 1, up"], 'y', [-1.0, 1.0], -0.8125),
        Handle::coordinate(["x2", "corner 2, right"], 'x', [-1.0, 1.0], 0.0),
        Handle::coordinate(["y2", "corner 2, up"], 'y', [-1.0, 1.0], -0.1875),
        Handle::coordinate(["x3", "corner 3, right"], 'x', [-1.0, 1.0], 0.9375),
        Handle::coordinate(["y3", "corner 3, up"], 'y', [-1.0, 1.0], -0.8125),
        Handle::coordinate(["x4", "corner 4, right"], 'x', [-1.0, 1.0], 0.6875),
        Handle::coordinate(["y4", "corner 4, up"], 'y', [-1.0, 1.0], 0.6875),
        Handle::coordinate(["x5", "corner 5, right"], 'x', [-1.0, 1.0], -0.6875),
        Handle::coordinate(["y5", "corner 5, up"], 'y', [-1.0, 1.0], 0.6875),
    ],
    make: dragged,
};

/// A polygon: its key, its name, and its corners in its plane, counter-clockwise.
type Example = (&'static str, &'static str, Vec<DVec2>);

/// Puts the corners into space, and rounds them to `f32` like a mesh.
fn in_space(corners: &[DVec2]) -> Vec<Vec3> {
    let placed = corners.iter().map(|c| tilt() * c.extend(0.0));
    placed.map(|c| c.as_vec3()).collect()
}

/// Returns the regular hexagon of radius 1.
fn hexagon() -> Vec<DVec2> {
    (0..6)
        .map(|k| DVec2::from_angle(f64::from(k) * core::f64::consts::FRAC_PI_3))
        .collect()
}

/// Returns a hexagon with one more corner between the first two, at the part `part` of their edge
/// and at the distance `outside` from it.
fn with_corner(part: f64, outside: f64) -> Vec<DVec2> {
    let mut corners = hexagon();
    let edge = corners[1] - corners[0];
    let outward = -edge.perp().normalize();
    corners.insert(1, corners[0] + part * edge + outside * outward);
    corners
}

/// Returns a regular polygon, three cases that the lecture names, and a reflex corner, which it
/// does not name.
fn examples() -> [Example; 5] {
    let beside = |outside| with_corner(0.5, outside);
    let reflex = [(-1.0, -0.8), (0.0, -0.2), (1.0, -0.8), (0.0, 1.0)].map(DVec2::from);
    [
        ("hexagon", "regular hexagon", hexagon()),
        ("short", "an edge of 10⁻⁶", with_corner(1e-6, 2e-7)),
        ("collinear", "three collinear vertices", beside(0.0)),
        ("nearly", "three nearly collinear vertices", beside(1e-7)),
        ("reflex", "a reflex corner", reflex.into()),
    ]
}

/// Returns the rotation that tilts all polygons, so that no coordinate is a round number.
fn tilt() -> DQuat {
    DQuat::from_rotation_arc(DVec3::Z, DVec3::new(0.31, 0.47, 0.83).normalize())
}

/// Computes (P_{i+1} − P_i) × (P_{i+2} − P_{i+1}), in `f32` like the corners. The result may be
/// zero.
fn two_edges(corners: &[Vec3], i: usize) -> DVec3 {
    let at = |k: usize| corners[(i + k) % corners.len()];
    (at(1) - at(0)).cross(at(2) - at(1)).as_dvec3()
}

fn by_newell(corners: &[Vec3]) -> DVec3 {
    newell(corners.iter().map(|corner| corner.as_dvec3()))
}

/// Returns the angle from the true normal in degrees, or infinity for a vector without a direction.
fn error(normal: DVec3) -> f64 {
    let unit = normal / normal.length();
    if unit.is_finite() {
        angle(unit, tilt() * DVec3::Z)
    } else {
        f64::INFINITY
    }
}

/// Returns the normal from two edges at each corner, the best first and the worst last.
fn by_two_edges(corners: &[Vec3]) -> Vec<DVec3> {
    let mut normals: Vec<_> = (0..corners.len()).map(|i| two_edges(corners, i)).collect();
    normals.sort_unstable_by(|a, b| error(*a).total_cmp(&error(*b)));
    normals
}

fn worst(corners: &[Vec3]) -> DVec3 {
    by_two_edges(corners)[corners.len() - 1]
}

/// Shows a polygon whose corners the reader drags, and measures its normals.
fn dragged(content: &mut FigureContent, values: &[f64]) -> Result {
    let plane: Vec<DVec2> = values
        .chunks_exact(2)
        .map(|v| DVec2::new(v[0], v[1]))
        .collect();
    let example = ("dragged", "this polygon", plane);
    let twice = twice_the_area(&example.2);
    let corners = in_space(&example.2);
    let panel = |caption: &str, normal: fn(&[Vec3]) -> DVec3| {
        let lit = lit_by(core::slice::from_ref(&example), normal)?;
        Ok::<_, FigureError>((String::from(caption), stored(&lit)))
    };
    let panels = [
        panel(
            "lit by the normal from two edges, at its worst corner",
            worst,
        )?,
        panel("lit by the normal of Newell\u{2019}s formula", by_newell)?,
    ];
    content.pictures(2, "The polygon", panels);
    let edges = error(worst(&corners));
    let sum = by_newell(&corners);
    failure(content, "dragged", example.1, edges);
    // If the corners run clockwise, the polygon shows its back and its normal shall point away.
    let off = if twice < 0.0 { error(-sum) } else { error(sum) };
    // Coordinates are sixteenths, so twice the area is a multiple of 1/256: less is rounding, and
    // zero.
    if twice.abs() > 1e-6 {
        let rounding = ROUNDING / twice.abs();
        right(content, off, rounding.to_degrees().max(LEAST_DEGREES));
        let area = (sum.length() / twice.abs() - 1.0).abs();
        as_long(content, area, rounding.max(LEAST_SHARE));
    } else {
        content.adds(
            "newell | |N| by Newell\u{2019}s formula",
            (sum.length(), "", true),
            "The polygon encloses no area, or as much on one side as on the other: it has no normal.",
        );
    }
    Ok(())
}

/// How far rounding the corners of a dragged polygon moves N, whose length is 2 Area. Coordinates
/// are below 2, so each of five corners moves by up to √3 · 2⁻²⁴, and N by this times the distance
/// between the corner's neighbours, at most 2√2.
const ROUNDING: f64 = 5.0 * 1.7321 * 2.8285 / (1u32 << 24) as f64;
/// The error in degrees and the relative difference of |N| that count as rounding, on polygons as
/// large as the examples.
const LEAST_DEGREES: f64 = 1e-4;
const LEAST_SHARE: f64 = 1e-6;

/// Adds the finding of the largest error of Newell's formula, in degrees. Up to `rounding` degrees
/// are rounding.
fn right(content: &mut FigureContent, most: f64, rounding: f64) {
    content.confirms(
        "newell | Newell's formula: largest error over all polygons",
        (most, "degrees", most < rounding),
        "That is the rounding of the corners, and no more.",
    );
}

/// Adds the finding of the largest relative difference of |N| from twice the area. Up to `rounding`
/// is rounding.
fn as_long(content: &mut FigureContent, area: f64, rounding: f64) {
    content.confirms(
        "area | |N| against 2 Area: largest relative difference",
        (area, "", area < rounding),
        "|N| = 2 Area, apart from rounding.",
    );
}

/// Draws all polygons twice, lit by the normal from two edges and by Newell's.
fn pictures(content: &mut FigureContent) -> Result {
    content.text(
        "All polygons lie in one tilted plane, and their corners are rounded to f32. The normal from two \
         edges is computed at the worst corner, because a file may begin with any corner. Newell's \
         formula sums over all of them.",
    );
    let names = examples().map(|(_, what, _)| what).join(", ");
    let edges = format!("lit by the normal from two edges, at its worst corner: {names}");
    let newell = "lit by the normal of Newell\u{2019}s formula".into();
    let all = examples();
    let panels = [
        (edges, &lit_by(&all, worst)?),
        (newell, &lit_by(&all, by_newell)?),
    ]
    .map(|(caption, picture)| (caption, stored(picture)));
    content.pictures(1, "Five polygons of one plane", panels);
    Ok(())
}

/// Measures the angles from the true normal, and the area.
fn errors(content: &mut FigureContent) -> Result {
    let (mut rows, mut most, mut area) = (Vec::new(), 0.0f64, 0.0f64);
    for (key, what, corners) in examples() {
        let twice = twice_the_area(&corners);
        let corners = in_space(&corners);
        let (edges, sum) = (by_two_edges(&corners), by_newell(&corners));
        let errors = [edges[0], edges[edges.len() - 1], sum].map(error);
        let [best, worst, newell] = errors.map(|error| {
            if error.is_finite() {
                format!("{}°", written(error))
            } else {
                "no direction".into()
            }
        });
        let length = sum.length();
        area = area.max((length / twice - 1.0).abs());
        most = most.max(errors[2].min(180.0));
        let cells = format!("{best} | {worst} | {newell} | {length:.7} | {twice:.7}");
        rows.push(format!("{what} | {cells}"));
        failure(content, key, what, errors[1]);
    }
    content.table(
        "polygon | two edges: best corner | worst corner | Newell | |N| | 2 Area",
        rows,
    );
    right(content, most, LEAST_DEGREES);
    as_long(content, area, LEAST_SHARE);
    Ok(())
}

/// Adds the finding of two edges at the worst corner, whose error is in degrees.
fn failure(content: &mut FigureContent, key: &str, what: &str, error: f64) {
    let fails = error > 1.0;
    let agreement = match key {
        "hexagon" => Agreement::if_holds(!fails),
        "reflex" | "dragged" => Agreement::Adds,
        _ => Agreement::if_holds(fails),
    };
    content.found(
        &format!(
            "{key} | two edges at the worst corner, {what}: error (180 if there is no direction)"
        ),
        // Without a direction a program may choose any: at worst the opposite one.
        (error.min(180.0), "degrees", true),
        agreement,
        match error {
            f64::INFINITY => "The two edges have no normal: their cross product is zero.",
            90.0.. => {
                "It points to the other side: the polygon would be culled, or lit from behind."
            }
            1.0.. => "It is visibly wrong.",
            _ => "It is good where nothing is degenerate.",
        },
    );
}

/// Draws polygons side by side, each lit by the normal that `normal` computes from its corners.
fn lit_by(examples: &[Example], normal: fn(&[Vec3]) -> DVec3) -> Result<LinearPicture> {
    // The light is far from the normal, where a few degrees are visible.
    let light = DVec3::new(-0.6, 0.3, 0.7);
    let polygon = |(i, (_, _, corners)): (usize, &Example)| {
        let middle = DVec2::new(24.0 + 48.0 * i as f64, 24.0);
        let corner =
            |c: &DVec2| ScreenCorner::new([middle.x + 21.0 * c.x, middle.y - 21.0 * c.y], DVec3::Z);
        ScreenPolygon {
            corners: corners.iter().map(corner).collect(),
            // A normal without a direction is turned away from the light, which leaves ambient
            // light.
            normal: normal(&in_space(corners)).try_normalize().unwrap_or(-light),
        }
    };
    let polygons: Vec<_> = examples.iter().enumerate().map(polygon).collect();
    draw(
        &frame(
            [48 * polygons.len() as u32, 48],
            grey(0.08, 0.9, 0.0, 1.0),
            light,
            &polygons,
        )?,
        "flat",
    )
}
