//! Reference pictures with pixels that were worked out by hand.

use super::fixtures::{between, polygon_of, vertex, z_light};
use super::{Model, ReferencePicture, Visibility, render, shade, visibility};
use crate::frame::{Frame, FrameBuilder, Vertex};
use crate::scene::{HiddenSurfaces, Interpolation};

/// The rounding of a normal's z to f32 (values up to 1: 2⁻²⁵), with room for a few roundings in f64
/// after it.
const F32: f64 = 3.1e-8;

/// Roundings in f64 only: some ten half-ulps of values up to 1.
const F64: f64 = 8.0 * f64::EPSILON;

/// Returns a unit normal with this z.
fn tilted(z: f64) -> [f32; 3] {
    [libm::sqrt(1.0 - z * z) as f32, 0.0, z as f32]
}

/// Returns the grey value of a pixel.
fn grey(picture: &ReferencePicture, x: usize, y: usize) -> f64 {
    let [r, g, b, a] = picture.picture.get(x, y);
    assert!(r == g && g == b && a == 1.0, "{r} {g} {b} {a}");
    r
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} instead of {expected}"
    );
}

/// Returns a square whose edges lie on the pixel centres of columns and rows 0 and `side`. Its
/// normals are in the order top left, top right, bottom right, bottom left.
fn square(side: f64, normals: [[f32; 3]; 4]) -> [Vertex; 4] {
    let (near, far) = (0.5, side + 0.5);
    let [a, b, c, d] = normals;
    [
        vertex((near, near), a),
        vertex((far, near), b),
        vertex((far, far), c),
        vertex((near, far), d),
    ]
}

#[test]
fn exercise_1_sine_of_24_3_degrees() {
    // L21 exercise 1: sin 24° = 0.40674, sin 25° = 0.42262. 0.3 of the way is 0.411504.
    let (sin24, sin25) = (tilted(0.40674), tilted(0.42262));
    let along_the_span = polygon_of(12, &square(10.0, [sin24, sin25, sin25, sin24]), |_| ());
    assert_near(
        grey(&render(&along_the_span, Model::Gouraud), 3, 6),
        0.411504,
        F32,
    );
    let along_the_edge = polygon_of(12, &square(10.0, [sin24, sin24, sin25, sin25]), |_| ());
    assert_near(
        grey(&render(&along_the_edge, Model::Gouraud), 0, 3),
        0.411504,
        F32,
    );
    // On a triangle: along its left edge and along its top edge.
    let [a, b, _, d] = square(10.0, [sin24, sin25, sin25, sin25]);
    let triangle = render(&polygon_of(12, &[a, b, d], |_| ()), Model::Gouraud);
    assert_near(grey(&triangle, 0, 3), 0.411504, F32);
    assert_near(grey(&triangle, 3, 0), 0.411504, F32);
}

#[test]
fn the_centroid_of_a_triangle_has_the_mean_of_its_corners() {
    let corners = [
        vertex((0.0, 0.0), tilted(0.25)),
        vertex((6.0, 0.0), tilted(0.5)),
        vertex((1.5, 4.5), tilted(0.75)),
    ];
    let frame = polygon_of(6, &corners, |_| ());
    assert_near(grey(&render(&frame, Model::Gouraud), 2, 1), 0.5, F64);
    // The mean normal also has z = ½, but is shorter than 1.
    let x: f64 = corners.iter().map(|v| f64::from(v.normal[0])).sum::<f64>() / 3.0;
    assert_near(
        grey(&render(&frame, Model::Phong), 2, 1),
        0.5 / libm::sqrt(0.25 + x * x),
        F64,
    );
}

#[test]
fn the_models_differ_where_they_should() {
    // Left normals point along x, right ones along z. The pixel is a third of the way between.
    let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let frame = polygon_of(8, &square(6.0, [x, z, z, x]), |_| ());
    let seen = visibility(&frame);
    let at = |model| grey(&shade(&frame, &seen, model), 2, 3);
    assert_near(at(Model::Flat), 0.0, 0.0);
    assert_near(at(Model::Gouraud), 1.0 / 3.0, F64);
    // (2/3, 0, 1/3) normalised.
    assert_near(at(Model::Phong), 1.0 / libm::sqrt(5.0), F64);
    // 30° from x: sin 30°.
    assert_near(at(Model::Slerp), 0.5, F64);
}

#[test]
fn flat_shading_uses_the_normal_of_the_polygon() {
    let z = [0.0, 0.0, 1.0];
    let mut builder = FrameBuilder::new(6, 6);
    builder.lighting(z_light());
    let corners = square(4.0, [z; 4]).map(|v| builder.vertex(v));
    builder.polygon(&corners, [0.0, 0.8, 0.6], 0);
    let frame = builder.finish().unwrap();
    assert_eq!(grey(&render(&frame, Model::Flat), 1, 2), f64::from(0.6f32));
    assert_eq!(grey(&render(&frame, Model::Gouraud), 1, 2), 1.0);
}

#[test]
fn slerp_on_a_triangle_goes_along_the_edges_then_along_the_span() {
    let apex = vertex((3.5, 0.5), [1.0, 0.0, 0.0]);
    let (left, right) = (
        vertex((0.5, 6.5), [0.0, 1.0, 0.0]),
        vertex((6.5, 6.5), [0.0, 0.0, 1.0]),
    );
    let frame = polygon_of(8, &[apex, left, right], |_| ());
    // Row 2 is a third of the way down: 30° along both edges, (cos 30°, sin 30°, 0) and (cos 30°,
    // 0, sin 30°). Half-way between them is their mean, (√3/2, 1/4, 1/4), normalised:
    // z = (1/4) / √(7/8).
    assert_near(
        grey(&render(&frame, Model::Slerp), 3, 2),
        0.25 / libm::sqrt(0.875),
        F64,
    );
    // Barycentric (2/3, 1/6, 1/6): z = 1/√18.
    assert_near(
        grey(&render(&frame, Model::Phong), 3, 2),
        1.0 / libm::sqrt(18.0),
        F64,
    );
}

#[test]
fn slerp_between_opposite_normals_shows_the_face() {
    let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let mut builder = FrameBuilder::new(6, 6);
    builder.lighting(z_light());
    let corners = square(4.0, [up, down, down, up]).map(|v| builder.vertex(v));
    builder.polygon(&corners, [0.0, 0.8, 0.6], 0);
    let picture = render(&builder.finish().unwrap(), Model::Slerp);
    for x in 0..4 {
        assert_eq!(grey(&picture, x, 2), f64::from(0.6f32));
    }
}

#[test]
fn where_opposite_normals_cancel_phong_shows_ambient_light() {
    let (up, down) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]);
    let mut builder = FrameBuilder::new(6, 6);
    let mut lighting = z_light();
    lighting.ambient = [0.25; 3];
    builder.lighting(lighting);
    let corners = square(4.0, [up, down, down, up]).map(|v| builder.vertex(v));
    builder.polygon(&corners, up, 0);
    let picture = render(&builder.finish().unwrap(), Model::Phong);
    assert_eq!([1, 2, 3].map(|x| grey(&picture, x, 2)), [1.0, 0.25, 0.25]);
}

#[test]
fn gouraud_clamps_vertices_before_it_interpolates() {
    let (bright, dark) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    let mut builder = FrameBuilder::new(6, 6);
    let mut lighting = z_light();
    lighting.lights[0].diffuse = [2.0; 3];
    builder.lighting(lighting);
    let corners = square(4.0, [bright, dark, dark, bright]).map(|v| builder.vertex(v));
    builder.polygon(&corners, bright, 0);
    // An unclamped intensity of 2 would give 1 in the middle.
    assert_near(
        grey(&render(&builder.finish().unwrap(), Model::Gouraud), 2, 2),
        0.5,
        F64,
    );
}

/// Returns [`square`], from dark at w = 1 on the left to bright at w = 3 on the right.
fn receding(interpolation: Interpolation, side: f64) -> Frame {
    let (dark, bright) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let mut corners = square(side, [dark, bright, bright, dark]);
    corners[1].inv_w = 1.0 / 3.0;
    corners[2].inv_w = 1.0 / 3.0;
    polygon_of(8, &corners, |builder| {
        builder.interpolation(interpolation);
    })
}

#[test]
fn perspective_weighs_the_near_side_more() {
    // In the middle of the screen: (0 · 1 + 1 · ⅓) / (1 + ⅓) = ¼. inv_w is rounded to f32.
    let frame = receding(Interpolation::Perspective, 4.0);
    assert_near(grey(&render(&frame, Model::Gouraud), 2, 1), 0.25, F32);
    // Normals have equal weights, (¾, 0, ¼): z = 1/√10.
    assert_near(
        grey(&render(&frame, Model::Phong), 2, 1),
        1.0 / libm::sqrt(10.0),
        F32,
    );
    let screen = receding(Interpolation::Screen, 4.0);
    assert_near(grey(&render(&screen, Model::Gouraud), 2, 1), 0.5, F64);
    // Slerp ignores w.
    assert_eq!(
        render(&frame, Model::Slerp).picture,
        render(&screen, Model::Slerp).picture
    );
    // A triangle, half-way along its top edge.
    let mut corners = square(
        4.0,
        [
            [1.0, 0.0, 0.0],
            [0.0, 0.0, 1.0],
            [0.0, 0.0, 1.0],
            [1.0, 0.0, 0.0],
        ],
    );
    corners[1].inv_w = 1.0 / 3.0;
    let triangle = polygon_of(8, &[corners[0], corners[1], corners[3]], |builder| {
        builder.interpolation(Interpolation::Perspective);
    });
    assert_near(grey(&render(&triangle, Model::Gouraud), 2, 0), 0.25, F32);
}

/// Returns a square whose right side comes from clipping, half-way from the left vertices to
/// vertices beyond the picture. `garbage` is the normal stored at the new vertices.
fn clipped(near: [f32; 3], far: [f32; 3], garbage: [f32; 3]) -> Frame {
    let mut builder = FrameBuilder::new(8, 8);
    builder.lighting(z_light());
    let [a, _, _, d] = square(4.0, [near; 4]).map(|v| builder.vertex(v));
    let beyond = builder.vertex(vertex((30000.0, 2.0), far));
    // The second clip corner is three quarters of the way: half-way from the first clip corner to
    // the far vertex.
    let half = builder.vertex(vertex((4.5, 0.5), garbage));
    let further = builder.vertex(vertex((4.5, 4.5), garbage));
    builder.clip_corner(between(half, a, beyond, 0.5));
    builder.clip_corner(between(further, half, beyond, 0.5));
    builder.polygon(&[a, half, further, d], [0.0, 0.0, 1.0], 0);
    builder.finish().unwrap()
}

#[test]
fn a_clip_corner_interpolates_its_parents() {
    let (x, z) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    let frame = clipped(x, z, [0.0, 0.6, 0.8]);
    let seen = visibility(&frame);
    // Row 0 lies on the edge from `a` to the first clip corner, column 2 half-way along it.
    let at = |model, x, y| grey(&shade(&frame, &seen, model), x, y);
    // Colours 0, ½, ¾.
    assert_near(at(Model::Gouraud, 2, 0), 0.25, F64);
    assert_near(
        at(Model::Gouraud, 2, 2),
        0.5 * (0.5 * 0.5 + 0.5 * 0.75),
        F64,
    );
    // Normals (1, 0, 0), (½, 0, ½): half-way (¾, 0, ¼). A normalised clip corner would give another
    // direction.
    assert_near(at(Model::Phong, 2, 0), 1.0 / libm::sqrt(10.0), F64);
    // 0° and 45°: half-way 22.5°.
    assert_near(at(Model::Slerp, 2, 0), libm::sin(22.5f64.to_radians()), F64);
    // Halfway down, the edge between 45° and 67.5° is at 56.25°. Half-way along the span is
    // 28.125°.
    assert_near(
        at(Model::Slerp, 2, 2),
        libm::sin(28.125f64.to_radians()),
        F64,
    );
}

#[test]
fn a_clip_corner_between_opposite_normals_has_the_face_that_was_clipped() {
    // The clipped face lies along x (`between`), so the new corner has normal x. There z is 0, and
    // at the left it is 1.
    let frame = clipped([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.6, 0.8]);
    // z to x is 90°, half-way 45°.
    assert_near(
        grey(&render(&frame, Model::Slerp), 2, 0),
        libm::sqrt(0.5),
        F64,
    );
}

/// Returns two squares over the same pixels, with these depths on their left and right sides.
fn two_layers(depth_test: bool, first: (f32, f32), second: (f32, f32)) -> Frame {
    let mut builder = FrameBuilder::new(6, 6);
    builder.lighting(z_light());
    builder.hidden_surfaces(if depth_test {
        HiddenSurfaces::default()
    } else {
        HiddenSurfaces::DrawOrder
    });
    for (source, (left, right)) in (0..).zip([first, second]) {
        let mut corners = square(4.0, [[0.0, 0.0, 1.0]; 4]);
        for (vertex, depth) in corners.iter_mut().zip([left, right, right, left]) {
            vertex.depth = f64::from(depth);
        }
        let corners = corners.map(|v| builder.vertex(v));
        builder.polygon(&corners, [0.0, 0.0, 1.0], source);
    }
    builder.finish().unwrap()
}

#[test]
fn the_nearest_polygon_is_seen_and_the_first_of_equal_ones() {
    let crossing = visibility(&two_layers(true, (0.25, 0.75), (0.5, 0.5)));
    assert_eq!(
        crossing.polygons.row(1),
        [0, 0, 0, 1, Visibility::NONE, Visibility::NONE]
    );
    assert_eq!(
        crossing.depth.row(1),
        [0.25, 0.375, 0.5, 0.5, f64::INFINITY, f64::INFINITY]
    );
    assert_eq!(
        crossing.depth_gap.row(1),
        [0.25, 0.125, 0.0, 0.125, f64::INFINITY, f64::INFINITY]
    );
    let other_order = visibility(&two_layers(true, (0.5, 0.5), (0.25, 0.75)));
    assert_eq!(
        other_order.polygons.row(1),
        [1, 1, 0, 0, Visibility::NONE, Visibility::NONE]
    );
    assert_eq!(other_order.depth_gap, crossing.depth_gap);
}

#[test]
fn the_gap_is_to_the_next_polygon_behind() {
    let mut builder = FrameBuilder::new(6, 6);
    builder.lighting(z_light());
    for depth in [0.75, 0.25, 0.5, 0.875] {
        let corners =
            square(4.0, [[0.0, 0.0, 1.0]; 4]).map(|v| builder.vertex(Vertex { depth, ..v }));
        builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
    }
    let seen = visibility(&builder.finish().unwrap());
    assert_eq!(
        (
            seen.polygons.get(1, 1),
            seen.depth.get(1, 1),
            seen.depth_gap.get(1, 1)
        ),
        (1, 0.25, 0.25)
    );
}

#[test]
fn without_depth_test_the_last_polygon_is_seen() {
    let seen = visibility(&two_layers(false, (0.25, 0.25), (0.5, 0.5)));
    assert_eq!((seen.polygons.get(1, 1), seen.depth.get(1, 1)), (1, 0.5));
    assert_eq!(seen.depth_gap.get(1, 1), f64::INFINITY);
}

#[test]
fn the_background_has_no_alpha() {
    let z = tilted(0.5);
    let frame = polygon_of(4, &square(2.0, [z; 4]), |builder| {
        builder.background([0.25, 0.5, 1.0]);
    });
    let picture = render(&frame, Model::Gouraud);
    assert_eq!(picture.picture.get(3, 3), [0.25, 0.5, 1.0, 0.0]);
    assert_eq!(picture.polygons.get(3, 3), Visibility::NONE);
    assert_eq!(picture.polygons.get(1, 1), 0);
    assert_eq!(picture.to_linear().get(3, 3), [0.25, 0.5, 1.0, 0.0]);
    // 63.75 is rounded up, 127.5 away from 0.
    assert_eq!(picture.to_picture8().get(3, 3), [64, 128, 255, 0]);
    assert_eq!(picture.to_picture8().get(1, 1), [128, 128, 128, 255]);
}

#[test]
fn a_foreign_visibility_leaves_the_background() {
    let z = [0.0, 0.0, 1.0];
    let large = visibility(&two_layers(false, (0.5, 0.5), (0.5, 0.5)));
    let frame = polygon_of(2, &square(1.0, [z; 4]), |_| ());
    for model in Model::ALL {
        assert_eq!(shade(&frame, &large, model).picture.get(3, 3), [0.0; 4]);
    }
}
