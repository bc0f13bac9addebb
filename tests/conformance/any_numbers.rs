//! Numbers that a caller hands to the library as they are: coordinates, and the state of the integer loops.

use fastphong::fixed::types::{I2F30, U16F16};
use fastphong::frame::{Frame, FrameBuilder, FrameError, FrameItem, SubPixel, Vertex, sub_pixel};
use fastphong::glam::DVec3;
use fastphong::integer::{
    Halfway, Light, Material, NoHighlight, Quadratic, Ramp, Reflection, Rgb888, fast, gouraud,
    naive, quadratic, unit,
};
use fastphong::mesh;
use fastphong::scene::Lighting;

/// Returns what a builder makes of a triangle whose first corner lies at a coordinate.
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
                Some(FrameError::Number {
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

const fn grey(level: &str) -> [U16F16; 3] {
    [U16F16::lit(level); 3]
}
static CLAY: Material<Rgb888> = Material::new(grey("0.1"), grey("0.5"), grey("0.4"), 32);

/// A sequence of 32 bits, always the same one.
struct Bits(u64);

impl Bits {
    fn next(&mut self) -> i32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005);
        self.0 = self.0.wrapping_add(1_442_695_040_888_963_407);
        // The ends of the range among them.
        match self.0 >> 60 {
            0 => i32::MIN,
            1 => i32::MAX,
            _ => (self.0 >> 27) as i32,
        }
    }
    fn ramp(&mut self) -> Ramp {
        Ramp {
            at: I2F30::from_bits(self.next()),
            step: I2F30::from_bits(self.next()),
        }
    }
    fn quadratic(&mut self) -> Quadratic {
        Quadratic {
            at: I2F30::from_bits(self.next()),
            step: I2F30::from_bits(self.next()),
            bend: I2F30::from_bits(self.next()),
        }
    }
}

/// Their state may come from anywhere: outside of its ranges colours are wrong, and nothing panics where overflow is checked.
#[test]
fn integer_loops_take_any_state() {
    let mut bits = Bits(1);
    let light = Light::new(unit([1, 2, 3]), unit([0, 0, 1]), &CLAY);
    let lights = [light, Light::new(unit([-3, 1, 2]), unit([0, 0, 1]), &CLAY)];
    let mut line = [Rgb888([0; 3]); 40];
    for _ in 0..2000 {
        let normal = [bits.ramp(), bits.ramp(), bits.ramp()];
        naive::<_, Reflection, false, 2>(&mut line, normal, &lights);
        naive::<_, Halfway, true, 2>(&mut line, normal, &lights);
        let (j, k) = ([bits.ramp(), bits.ramp()], [bits.ramp(), bits.ramp()]);
        let d = bits.quadratic();
        fast::<_, Reflection, false, 2>(&mut line, j, k, d, &lights);
        fast::<_, Halfway, true, 2>(&mut line, j, k, d, &lights);
        fast::<_, NoHighlight, true, 2>(&mut line, j, k, d, &lights);
        let (l_n, cosine) = ([bits.quadratic(), d], [bits.quadratic(), bits.quadratic()]);
        quadratic::<_, Reflection, 2>(&mut line, l_n, cosine, &lights);
        quadratic::<_, Halfway, 2>(&mut line, l_n, cosine, &lights);
        gouraud(&mut line, bits.next() as u32, bits.next() as u32);
    }
}
