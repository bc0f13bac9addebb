//! Frames that a program builds from any values: each is refused, or every method draws it or
//! refuses it, and nothing panics.

use super::passes;
use super::renderers::distinct;
use fastphong::frame::triangulate::triangulated;
use fastphong::frame::{
    ClipCorner, DepthRange, Frame, FrameBuilder, Mean, SubPixel, Vertex, sub_pixel,
};
use fastphong::mesh::Material;
use fastphong::picture::Encoding;
use fastphong::raster;
use fastphong::reference::{self, Model};
use fastphong::scene::{
    Clipping, DepthBuffer, Falloff, HiddenSurfaces, Interpolation, Light, Lighting, PainterKey,
    Place, SpecularGate, SpecularModel,
};
use fastphong::shading::METHODS;
use glam::DVec3;
use proptest::prelude::*;

/// Values that break arithmetic.
const WILD: [f64; 12] = [
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    0.0,
    -1.0,
    1e-45,
    1e30,
    f32::MAX as f64,
    f64::MAX,
    5e-324,
    -1e16,
    32_768.0,
];

/// Returns random numbers, from which [`frame`] makes its choices.
pub fn choices() -> BoxedStrategy<Vec<u32>> {
    prop::collection::vec(any::<u32>(), 1..400).boxed()
}

/// The numbers that are left to choose by. At their end all choices are the first ones.
struct Choices<'a> {
    rest: std::slice::Iter<'a, u32>,
    /// True if some values are wild.
    is_wild: bool,
}

impl Choices<'_> {
    fn next(&mut self) -> u32 {
        self.rest.next().copied().unwrap_or(0)
    }
    fn below(&mut self, count: usize) -> usize {
        self.next() as usize % count
    }
    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
    /// Returns a value between two others, or rarely a wild one.
    fn value(&mut self, least: f64, most: f64) -> f64 {
        let x = self.next();
        if self.is_wild && x % 256 == 255 {
            return WILD[x as usize / 256 % WILD.len()];
        }
        least + (most - least) * f64::from(x) / f64::from(u32::MAX)
    }
    fn three(&mut self, least: f64, most: f64) -> [f32; 3] {
        [0; 3].map(|_| self.value(least, most) as f32)
    }
    fn lighting(&mut self) -> Lighting {
        let lights: Vec<Light> = (0..self.of(&[1, 2, 0, 5, 64, 1, 1, 3]))
            .map(|_| {
                let [x, y, z] = self.three(-3.0, 3.0).map(f64::from);
                let at = DVec3::new(x, y, z);
                let light = match self.below(3) {
                    0 => Light::positional(at, [0.6; 3]),
                    _ => Light::directional(at, [0.6; 3]),
                };
                let attenuation = Falloff::Attenuation(self.value(0.0, 2.0) as f32);
                light.with_falloff(self.of(&[Falloff::None, Falloff::InverseSquare, attenuation]))
            })
            .collect();
        let material = Material {
            shininess: self.value(0.0, 90.0) as f32,
            ..Material::default()
        };
        let mut lighting = Lighting::new(&material, [1.0; 3], &lights, DVec3::Z);
        if self.below(4) == 3 {
            lighting.view = Place::Local(self.three(-3.0, 3.0));
        }
        lighting.specular = self.of(&[SpecularModel::Phong, SpecularModel::Blinn]);
        lighting.gate = self.of(&[
            SpecularGate::Gated,
            SpecularGate::Ungated,
            SpecularGate::Weighted,
        ]);
        lighting.vertex_colours = self.below(3) == 2;
        lighting
    }
}

/// Builds a frame by random choices. Returns `None` if it is refused.
fn frame(numbers: &[u32]) -> Option<Frame> {
    let mut of = Choices {
        is_wild: numbers.len().is_multiple_of(2),
        rest: numbers.iter(),
    };
    let sides = [16, 1, 33, 2, 8];
    let samples = of.of(&[1, 1, 1, 2, 4]);
    let [width, height] = [(); 2].map(|()| of.of(&sides) * samples);
    let mut builder = FrameBuilder::new(width, height);
    let is_perspective = of.below(2) == 1;
    let (near, far) = (of.value(0.01, 1.0), of.of(&[9.0, f64::INFINITY, 1e20]));
    builder
        .samples(samples)
        .interpolation(of.of(&[Interpolation::Screen, Interpolation::Perspective]))
        .hidden_surfaces(of.of(&[
            HiddenSurfaces::ZBuffer(DepthBuffer::default()),
            HiddenSurfaces::ZBuffer(DepthBuffer::default()),
            HiddenSurfaces::DrawOrder,
            HiddenSurfaces::Painter(PainterKey::Mean),
        ]))
        .clipping(if of.below(8) == 7 {
            Clipping::NdcCube
        } else {
            Clipping::Planes
        })
        .encoding(of.of(&[Encoding::Linear, Encoding::Srgb]));
    if is_perspective {
        builder.depth_range(DepthRange::Perspective { near, far });
    }
    let materials = 1 + of.below(2) as u32;
    for _ in 0..materials {
        builder.lighting(of.lighting());
    }
    let count = 3 + of.below(12) as u32;
    let in_clip_space = of.below(3);
    for vertex in 0..count {
        let material = if materials > 1 { vertex / 4 % 2 } else { 0 };
        let normal = of.three(-1.0, 1.0);
        let [x, y, z] = [(); 3].map(|()| of.value(-2.0, 2.0));
        if in_clip_space == 2 || in_clip_space == 1 && vertex % 2 == 0 {
            let w = if is_perspective {
                of.value(-1.0, 9.0)
            } else {
                1.0
            };
            builder.vertex_from_clip([x, y, z, w], normal, material);
        } else {
            let weight = of.value(0.2, 1.0);
            builder.vertex(Vertex {
                x: sub_pixel(10.0 * x),
                y: SubPixel::from_num(of.below(40) as i32 - 8),
                depth: if is_perspective {
                    -weight / near
                } else {
                    weight
                },
                inv_w: weight,
                normal,
                material,
            });
        }
    }
    let has_positions = of.below(4);
    for vertex in 0..count {
        if has_positions > 0 {
            builder.position(vertex, of.three(-2.0, 2.0));
        }
        if has_positions > 1 {
            builder.colour(vertex, of.three(0.0, 1.0));
        }
    }
    if of.below(8) == 7 {
        builder.clip_corner(ClipCorner {
            vertex: of.below(5) as u32,
            a: of.below(5) as u32,
            b: of.below(5) as u32,
            t: of.value(0.0, 1.0) as f32,
            face: of.three(-1.0, 1.0),
        });
    }
    for source in 0..1 + of.below(8) {
        // Mostly of the vertices that have the first material.
        let most = if materials > 1 { count.min(4) } else { count } as usize;
        let most = if of.is_wild && of.below(32) == 31 {
            99
        } else {
            most
        };
        let sides = of.of(&[3, 3, 3, 4, 4, 5, 7, 200]);
        let corners: Vec<u32> = (0..sides).map(|_| of.below(most) as u32).collect();
        if of.below(8) == 7 {
            builder.mean(Mean {
                position: of.three(-2.0, 2.0),
                normal: of.three(-0.5, 0.5),
                colour: of.three(0.0, 1.0),
            });
        }
        builder.polygon(&corners, of.three(-1.0, 1.0), source as u32);
    }
    builder.finish().ok()
}

/// Draws a frame that random choices build. Returns true if it was not refused.
///
/// # Errors
/// A sentence about a pass that differs.
pub fn draw(numbers: &[u32]) -> Result<bool, String> {
    let Some(frame) = frame(numbers) else {
        return Ok(false);
    };
    for row in METHODS {
        let variant = row.variant();
        for renderer in distinct(&variant, &frame) {
            let linear = variant.render_linear_with(&frame, renderer);
            let linear = linear.map_err(|error| error.to_string())?;
            let is_colour = |p: &[f32; 4]| p.iter().all(|c| (0.0..=1.0).contains(c));
            if let Some(pixel) = linear.pixels().iter().find(|p| !is_colour(p)) {
                return Err(format!("{variant}: a pixel is {pixel:?}"));
            }
            let stored = variant.render_with(&frame, renderer);
            stored.map_err(|error| error.to_string())?;
        }
        variant.polygon_bounds(&frame).for_each(drop);
    }
    passes::check(&frame)?;
    raster::normals(&frame);
    raster::depth(&frame);
    triangulated(&frame);
    reference::render(&frame, Model::Phong);
    Ok(true)
}
