//! Pictures of quantities other than colour: depth, normals, numbers and kinds of polygons, vertex colours, a checkerboard.

use fastphong::frame::Frame;
use fastphong::picture::encoding::{quantise, store};
use fastphong::picture::{Encoding, LinearPicture, Picture, Picture8};
use fastphong::raster;
use fastphong::shading::Variant;

/// A quantity that a picture shows instead of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Aov {
    /// Depth: the nearest pixel white, the farthest black; in .pfm as it is, 0 at the near plane, 1 at the far plane
    Depth,
    /// World-space normal N as the colour (N + 1)/2
    Normal,
    /// Visible polygon, each in a colour of its own; in .pfm its number in the scene, -1 where there is none
    Polygon,
    /// Kind by which `--method` draws the visible polygon, for methods that tell kinds apart; in .pfm its number, -1 where there is none [default method: adaptive-phong]
    Kind,
    /// Vertex colours, interpolated; white where the mesh has none
    Colours,
    /// Checkerboard on the world's x and z, with squares of `--square` world units
    Checkerboard,
}

/// What the quantities are of.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The side of a square of the checkerboard, in world units.
    pub square: f64,
    /// The method whose kinds of polygons are shown.
    pub variant: Variant,
}

/// The colours of kinds of polygons, in their order: after Okabe and Ito, whose colours all eyes tell apart.
pub const KINDS: [(&str, [u8; 4]); 5] = [
    ("grey", [153, 153, 153, 255]),
    ("blue", [86, 180, 233, 255]),
    ("green", [0, 158, 115, 255]),
    ("orange", [230, 159, 0, 255]),
    ("red", [213, 94, 0, 255]),
];

/// The colours of the checkerboard: linear.
const BOARD: [[f32; 3]; 2] = [[0.9; 3], [0.1, 0.15, 0.35]];

impl Aov {
    /// Returns the name on the command line.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// Returns the quantity as floats. Depth is infinite where nothing is seen.
    pub fn linear(self, frame: &Frame, subject: &Subject) -> LinearPicture {
        let grey = |value: f32, seen: bool| [value, value, value, f32::from(u8::from(seen))];
        match self {
            Aov::Colours => raster::vertex_colours(frame, None),
            Aov::Checkerboard => raster::checkerboard(frame, None, subject.square, BOARD),
            Aov::Normal => raster::normals(frame),
            Aov::Depth => raster::depth(frame).map(|depth| grey(depth, depth.is_finite())),
            Aov::Polygon => raster::polygon_numbers(frame).map(|number| {
                match frame.polygons().get(number as usize) {
                    // A scene holds at most 2^24 polygons an object: the number is exact.
                    Some(polygon) => grey(polygon.source as f32, true),
                    None => grey(-1.0, false),
                }
            }),
            Aov::Kind => kinds(frame, &subject.variant).map(|kind| match kind {
                Some(kind) => grey(f32::from(kind), true),
                None => grey(-1.0, false),
            }),
        }
    }

    /// Returns the encoding of the quantity in 8 bits: levels of depth and normals are proportional to them.
    pub fn encoding(self, frame: &Frame) -> Encoding {
        match self {
            Aov::Colours | Aov::Checkerboard => frame.encoding(),
            Aov::Depth | Aov::Normal => Encoding::Linear,
            Aov::Polygon | Aov::Kind => Encoding::Srgb,
        }
    }

    /// Returns the quantity in 8 bits, for eyes.
    pub fn stored(self, frame: &Frame, subject: &Subject) -> Picture8 {
        match self {
            Aov::Colours | Aov::Checkerboard => {
                store(&self.linear(frame, subject), frame.encoding())
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
            Aov::Kind => kinds(frame, &subject.variant)
                .map(|kind| kind.map_or([0; 4], |kind| KINDS[usize::from(kind)].1)),
        }
    }
}

/// Returns the kind by which a method draws the polygon that is seen at each pixel.
fn kinds(frame: &Frame, variant: &Variant) -> Picture<Option<u8>> {
    let kinds = variant.kinds_of_polygons(frame);
    raster::polygon_numbers(frame).map(|number| kinds.get(number as usize).copied())
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
