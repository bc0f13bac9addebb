//! Pictures of quantities other than colour: depth, normals, polygons and their kinds, vertex
//! colours, a checkerboard.

use fastphong::frame::Frame;
use fastphong::picture::encoding::{quantise, store};
use fastphong::picture::{Encoding, LinearPicture, Picture, Picture8};
use fastphong::raster;
use fastphong::shading::Variant;

/// A quantity that a picture shows instead of colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Aov {
    /// Depth: the nearest pixel is white, the farthest black; .pfm stores the depth itself, 0 at
    /// the near plane, 1 at the far plane
    Depth,
    /// World-space normal N as the colour (N + 1)/2
    Normal,
    /// Visible polygon, each in its own colour; .pfm stores its index in the scene, -1 where there
    /// is none
    Polygon,
    /// Kind of the visible polygon, for a `--method` that draws several kinds; .pfm stores the
    /// kind's index, -1 where there is none [default method: adaptive-phong]
    Kind,
    /// Vertex colours, interpolated; white where the mesh has none
    Colours,
    /// Checkerboard over the world's x and z, with squares of `--square` world units
    Checkerboard,
}

/// The parameters of a quantity.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The side of a square of the checkerboard, in world units.
    pub square: f64,
    /// The method whose kinds [`Aov::Kind`] shows.
    pub variant: Variant,
}

/// The names and colours of the kinds, in order. The colours are Okabe and Ito's, which
/// colour-blind eyes can tell apart.
pub const KINDS: [(&str, [u8; 4]); 5] = [
    ("grey", [153, 153, 153, 255]),
    ("blue", [86, 180, 233, 255]),
    ("green", [0, 158, 115, 255]),
    ("orange", [230, 159, 0, 255]),
    ("red", [213, 94, 0, 255]),
];

/// The two linear colours of the checkerboard.
const BOARD: [[f32; 3]; 2] = [[0.9; 3], [0.1, 0.15, 0.35]];

impl Aov {
    /// Returns the name on the command line.
    pub fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }

    /// Returns the flags of a scene that do not change this quantity.
    pub fn unused_flags(self) -> Vec<&'static str> {
        const LIGHT: &[&str] = &[
            "light",
            "light-at",
            "attenuation",
            "falloff",
            "no-lights",
            "ambient",
            "ka",
            "kd",
            "ks",
            "shininess",
            "viewer",
            "specular",
            "shininess-for",
            "specular-gate",
        ];
        const OF_VERTICES: &[&str] = &["normals", "normals-weight", "interpolation", "colours"];
        const COLOUR: &[&str] = &["background", "encoding"];
        match self {
            Aov::Depth | Aov::Polygon => [LIGHT, OF_VERTICES, COLOUR].concat(),
            Aov::Kind => COLOUR.to_vec(),
            Aov::Normal => [LIGHT, &["colours", "encoding"]].concat(),
            Aov::Colours | Aov::Checkerboard => {
                [LIGHT, &["normals", "normals-weight", "colours"]].concat()
            }
        }
    }

    /// Returns the quantity as floats. Depth is infinite where no polygon is visible.
    pub fn linear(self, frame: &Frame, subject: &Subject) -> LinearPicture {
        let grey = |value: f32, seen: bool| [value, value, value, f32::from(u8::from(seen))];
        match self {
            Aov::Colours => raster::vertex_colours(frame, None),
            Aov::Checkerboard => raster::checkerboard(frame, None, subject.square, BOARD),
            Aov::Normal => raster::normals(frame),
            Aov::Depth => raster::depth(frame).map(|depth| grey(depth, depth.is_finite())),
            Aov::Polygon => raster::polygon_indices(frame).map(|index| {
                match frame.polygons().get(index as usize) {
                    // A scene holds at most 2^24 polygons an object, so that `f32` holds the index
                    // exactly.
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

    /// Returns the encoding of the 8-bit picture. Depth and normals are linear: a level is
    /// proportional to the quantity.
    pub fn encoding(self, frame: &Frame) -> Encoding {
        match self {
            Aov::Colours | Aov::Checkerboard => frame.encoding(),
            Aov::Depth | Aov::Normal => Encoding::Linear,
            Aov::Polygon | Aov::Kind => Encoding::Srgb,
        }
    }

    /// Returns the quantity as an 8-bit picture to look at.
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
                depth.map(|depth| {
                    if depth.is_finite() {
                        let grey = quantise(1.0 - (depth - near) / range);
                        [grey, grey, grey, 255]
                    } else {
                        [0; 4]
                    }
                })
            }
            Aov::Polygon => raster::polygon_indices(frame).map(|index| {
                let polygon = frame.polygons().get(index as usize);
                polygon.map_or([0; 4], |polygon| colour_of_index(polygon.source))
            }),
            Aov::Kind => kinds(frame, &subject.variant)
                .map(|kind| kind.map_or([0; 4], |kind| KINDS[usize::from(kind)].1)),
        }
    }
}

/// Returns, for each pixel, the kind of the visible polygon.
fn kinds(frame: &Frame, variant: &Variant) -> Picture<Option<u8>> {
    let kinds = variant.kinds_of_polygons(frame);
    raster::polygon_indices(frame).map(|index| kinds.get(index as usize).copied())
}

/// Returns the colour of the polygon at `index`. Polygons with neighbouring indices get colours
/// that look different, and a polygon keeps its colour in every view.
fn colour_of_index(index: u32) -> [u8; 4] {
    // The finaliser of MurmurHash3 (Austin Appleby, public domain): every input bit changes about
    // half of the output bits.
    let mut h = index.wrapping_add(1);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    let [r, g, b, _] = (h ^ (h >> 16)).to_le_bytes();
    // The constants keep a polygon from being as dark as the background. Odd indices get more
    // green, so that neighbours in a row of polygons differ even if their hashes are close.
    let lift = if index.is_multiple_of(2) { 0 } else { 128 };
    [48 | r, 32 + g / 4 + lift, 48 | b, 255]
}
