//! Values that the library accepts from its caller unchecked: coordinates, and the colours of
//! integer lines.

use fastphong::frame::{Frame, FrameBuilder, FrameError, FrameItem, SubPixel, Vertex, sub_pixel};
use fastphong::glam::DVec3;
use fastphong::integer::{Rgb888, gouraud};
use fastphong::mesh;
use fastphong::scene::Lighting;

/// Builds a frame of a triangle whose first corner lies at a coordinate.
fn with_corner_at(x: SubPixel, y: SubPixel) -> Result<Frame, FrameError> {
    let mut builder = FrameBuilder::new(64, 64);
    let lighting = Lighting::new(&mesh::Material::default(), [1.0; 3], &[], DVec3::Z);
    let material = builder.lighting(lighting);
    let places = [
        (x, y),
        (sub_pixel(60.0), sub_pixel(0.0)),
        (sub_pixel(0.0), sub_pixel(60.0)),
    ];
    let corners = places.map(|(x, y)| {
        builder.vertex(Vertex {
            x,
            y,
            depth: 0.5,
            inv_w: 1.0,
            normal: [0.0, 0.0, 1.0],
            material,
        })
    });
    builder.polygon(&corners, [0.0, 0.0, 1.0], 0);
    builder.finish()
}

#[test]
fn coordinates_beyond_their_type_are_refused_and_do_not_wrap() {
    let middle = sub_pixel(32.0);
    // 2²⁴ + 30 pixels are 30 in the type's 32 bits.
    let far = [
        16_777_246.0,
        1e30,
        f64::MAX,
        f64::INFINITY,
        f64::NAN,
        33_000.0,
    ];
    for at in far.into_iter().chain(far.map(|x| -x)) {
        for (x, y) in [(sub_pixel(at), middle), (middle, sub_pixel(at))] {
            let refused = with_corner_at(x, y).err();
            let is_named = matches!(
                refused,
                Some(FrameError::Value {
                    item: FrameItem::Vertex(0),
                    ..
                })
            );
            assert!(is_named, "{at}: {refused:?}");
        }
        assert_eq!(sub_pixel(at as f32), sub_pixel(f64::from(at as f32)));
    }
    assert_eq!(sub_pixel(16_777_246.0), SubPixel::MAX);
    assert_eq!(sub_pixel(-16_777_246.0f32), SubPixel::MIN);
    assert!(with_corner_at(sub_pixel(-32_768.0), sub_pixel(32_768.0)).is_ok());
}

#[test]
fn coordinates_are_the_nearest_sub_pixels() {
    for (pixels, bits) in [
        (0.0, 0),
        (1.0, 256),
        (-0.5, -128),
        (1.5 / 256.0, 2),
        (2.5 / 256.0, 2),
        (-2.501 / 256.0, -3),
        (f64::MIN_POSITIVE, 0),
    ] {
        assert_eq!(sub_pixel(pixels).to_bits(), bits, "{pixels}");
    }
}

/// Any bits may stand for a colour: outside of their fields they are ignored, and nothing panics
/// where overflow is checked.
#[test]
fn an_integer_line_takes_any_colours() {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005);
        state = state.wrapping_add(1_442_695_040_888_963_407);
        // The ends of the range are among them.
        match state >> 60 {
            0 => 0,
            1 => u32::MAX,
            _ => (state >> 27) as u32,
        }
    };
    let mut line = [Rgb888([0; 3]); 300];
    for _ in 0..2000 {
        gouraud(&mut line, next(), next());
    }
}
