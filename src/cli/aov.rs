//! Pictures of quantities other than colour: depth, normals, polygon numbers, vertex colours, a checkerboard.

use fastphong::frame::Frame;
use fastphong::picture::encoding::{quantise, store};
use fastphong::picture::{Encoding, LinearPicture, Picture8};
use fastphong::raster;

/// A quantity that a picture shows instead of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Aov {
    /// Depth: the nearest pixel white, the farthest black; in .pfm as it is, 0 at the near plane, 1 at the far plane
    Depth,
    /// World-space normal N as the colour (N + 1)/2
    Normal,
    /// Visible polygon, each in a colour of its own; in .pfm its number in the scene, -1 where there is none
    Polygon,
    /// Vertex colours, interpolated; white where the mesh has none
    Colours,
    /// Checkerboard on the world's x and z, with squares of `--square` world units
    Checkerboard,
}

/// The colours of the checkerboard: linear.
const BOARD: [[f32; 3]; 2] = [[0.9; 3], [0.1, 0.15, 0.35]];

impl Aov {
    /// Returns the name on the command line.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// Returns the quantity as floats. Depth is infinite where nothing is seen. `square` is the side of a square, in world units.
    pub fn linear(self, frame: &Frame, square: f64) -> LinearPicture {
        let grey = |value: f32, seen: bool| [value, value, value, f32::from(u8::from(seen))];
        match self {
            Aov::Colours => raster::vertex_colours(frame, None),
            Aov::Checkerboard => raster::checkerboard(frame, None, square, BOARD),
            Aov::Normal => raster::normals(frame),
            Aov::Depth => raster::depth(frame).map(|depth| grey(depth, depth.is_finite())),
            Aov::Polygon => raster::polygon_numbers(frame).map(|number| {
                match frame.polygons().get(number as usize) {
                    // A scene holds at most 2^24 polygons an object: the number is exact.
                    Some(polygon) => grey(polygon.source as f32, true),
                    None => grey(-1.0, false),
                }
            }),
        }
    }

    /// Returns the encoding of the quantity in 8 bits: levels of depth and normals are proportional to them.
    pub fn encoding(self, frame: &Frame) -> Encoding {
        match self {
            Aov::Colours | Aov::Checkerboard => frame.encoding(),
            Aov::Depth | Aov::Normal => Encoding::Linear,
            Aov::Polygon => Encoding::Srgb,
        }
    }

    /// Returns the quantity in 8 bits, for eyes.
    pub fn stored(self, frame: &Frame, square: f64) -> Picture8 {
        match self {
            Aov::Colours | Aov::Checkerboard => {
                store(&self.linear(frame, square), frame.encoding())
            }
            Aov::Normal => raster::normals(frame).map(|pixel| pixel.map(quantise)),
            Aov::Depth => {
                let depth = raster::depth(frame);
                let drawn = depth.pixels().iter().filter(|depth| depth.is_finite());
                let (near, far) = drawn.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), d| {
                    (d.min(a), d.max(b))
                });
                let range = if far > near { far - near } else { 1.0 };
                depth.map(|depth| match depth.is_finite() {
                    true => {
                        let grey = quantise(1.0 - (depth - near) / range);
                        [grey, grey, grey, 255]
                    }
                    false => [0; 4],
                })
            }
            Aov::Polygon => raster::polygon_numbers(frame).map(|number| {
                let polygon = frame.polygons().get(number as usize);
                polygon.map_or([0; 4], |polygon| colour_of_number(polygon.source))
            }),
        }
    }
}

/// Returns the colour of a polygon: unlike those of the numbers around it, and the same in every view.
fn colour_of_number(number: u32) -> [u8; 4] {
    // The finaliser of MurmurHash3 (Austin Appleby, public domain): every bit of the number moves every bit.
    let mut h = number.wrapping_add(1);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    let [r, g, b, _] = (h ^ (h >> 16)).to_le_bytes();
    // Not so dark as to be taken for the background. Odd numbers are lighter in green: neighbours in a row of polygons
    // differ by that alone.
    let lift = if number.is_multiple_of(2) { 0 } else { 128 };
    [48 | r, 32 + g / 4 + lift, 48 | b, 255]
}
