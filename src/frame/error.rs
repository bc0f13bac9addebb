//! The error of a frame that cannot be made.

use super::Frame;
use crate::number::Written;
use crate::scene::Scene;
use core::fmt;

/// The item of a scene or a frame that has a wrong value. Items count from 0, in the order in which
/// they were passed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameItem {
    /// The camera, or the depth range in its place.
    Camera,
    /// The picture: its background.
    Picture,
    /// The scene as a whole: its ambient light, or the origin of its positions.
    Scene,
    /// A light of a scene.
    Light(usize),
    /// An object of a scene.
    Object(usize),
    /// A material. A scene counts them over all objects; each object has the materials of its mesh
    /// and then a default one.
    Material(usize),
    /// A light as it falls on a material.
    LightOn {
        /// The light.
        light: usize,
        /// The material.
        material: usize,
    },
    /// A vertex.
    Vertex(usize),
    /// A polygon.
    Polygon(usize),
    /// A clip corner.
    ClipCorner(usize),
}

impl fmt::Display for FrameItem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            FrameItem::Camera => f.write_str("the camera"),
            FrameItem::Picture => f.write_str("the picture"),
            FrameItem::Scene => f.write_str("the scene"),
            FrameItem::Light(light) => write!(f, "light {light}"),
            FrameItem::Object(object) => write!(f, "object {object}"),
            FrameItem::Material(material) => write!(f, "material {material}"),
            FrameItem::LightOn { light, material } => {
                write!(f, "light {light} on material {material}")
            }
            FrameItem::Vertex(vertex) => write!(f, "vertex {vertex}"),
            FrameItem::Polygon(polygon) => write!(f, "polygon {polygon}"),
            FrameItem::ClipCorner(corner) => write!(f, "clip corner {corner}"),
        }
    }
}

/// The reason why a frame cannot be made.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrameError {
    /// A side of the picture is 0 or over [`Scene::MAX_SIDE`].
    Size {
        /// Pixels in a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The samples of a pixel along each side are not 1, 2, 4 or 8, do not divide the frame's width
    /// and height, or make the frame too large.
    Samples {
        /// How many samples were asked for.
        samples: u32,
    },
    /// [`Clipping::NdcCube`](crate::scene::Clipping) together with
    /// [`Interpolation::Perspective`](crate::scene::Interpolation). Corners behind the eye have no
    /// weight for it.
    Unclipped,
    /// A material has more lights than [`Scene::MAX_LIGHTS`], or not as many as the others.
    Lights {
        /// How many lights the material has.
        found: usize,
    },
    /// A value is outside its range. NaN is outside every range.
    Value {
        /// The item that has the value.
        item: FrameItem,
        /// The value's name, like "red of its colour".
        name: &'static str,
        /// The value.
        value: f64,
        /// The range, in words.
        expected: &'static str,
    },
    /// A light of a scene stands at a vertex, where the direction toward it is undefined.
    LightAtVertex {
        /// The index of the light.
        light: usize,
        /// The vertex's position in world space.
        point: [f64; 3],
    },
    /// A vertex has no position, but a light or the eye is at a position, or other vertices have
    /// theirs.
    Position {
        /// The index of the vertex.
        index: usize,
    },
    /// There are more corners or vertices than 32-bit indices can name.
    TooLarge,
    /// Perspective interpolation is asked for, but the farthest vertex is over 2⁶⁰ times as far
    /// away as the nearest.
    Weights,
    /// A vertex has no place on the picture: it is outside the guard band, or its weight is not
    /// positive.
    Vertex {
        /// The index of the vertex.
        index: usize,
    },
    /// A polygon has fewer than three corners, or refers to a vertex or a material that does not
    /// exist, or to vertices of two materials. Or it must be clipped, but not all of its vertices
    /// are in clip space.
    Polygon {
        /// The index of the polygon.
        index: usize,
    },
    /// A clip corner refers to a vertex that does not exist, or does not come after its ends, or is
    /// out of order.
    ClipCorner {
        /// The index of the clip corner.
        index: usize,
    },
}

impl fmt::Display for FrameError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            FrameError::Size { width, height } => {
                write!(
                    f,
                    "the picture size {width}x{height} is outside 1x1 to {0}x{0}",
                    Scene::MAX_SIDE
                )
            }
            FrameError::Samples { samples } => write!(
                f,
                "{samples} samples per pixel along each side: expected 1, 2, 4 or 8, and at most {} along the picture's",
                Scene::MAX_SIDE
            ),
            FrameError::Unclipped => write!(
                f,
                "polygons are not clipped, but tested against the cube at each sample: expected attributes that are linear \
                 on the screen, as corners behind the eye have no weight"
            ),
            FrameError::Lights { found } => write!(
                f,
                "{found} lights, where at most {} are possible, the same on every material",
                Scene::MAX_LIGHTS
            ),
            FrameError::Value {
                item,
                name,
                value,
                expected,
            } => write!(f, "{item}: {name} is {}: expected {expected}", Short(value)),
            FrameError::LightAtVertex { light, point } => {
                let [x, y, z] = point.map(Written);
                write!(
                    f,
                    "light {light} stands at a vertex, ({x}, {y}, {z}): expected a place off the vertices, as there the \
                     direction toward the light is undefined"
                )
            }
            FrameError::Position { index } => write!(
                f,
                "vertex {index} has no position: expected one for every vertex, as a light or the eye is at a position, or \
                 other vertices have theirs"
            ),
            FrameError::TooLarge => {
                write!(f, "the scene has more corners than 32-bit indices can name")
            }
            FrameError::Weights => write!(
                f,
                "the farthest vertex in view is over 10¹⁸ times as far from the eye as the nearest: expected attributes that \
                 are linear on the screen, or a near plane that leaves the nearest out"
            ),
            FrameError::Vertex { index } => {
                write!(
                    f,
                    "vertex {index} is outside the guard band of {} pixels, not finite, or so far away that its 1/w is 0 in 32 bits",
                    Frame::GUARD
                )
            }
            FrameError::Polygon { index } => {
                write!(
                    f,
                    "polygon {index} has fewer than three corners, or refers to a vertex or a material that does not exist, \
                     or to vertices of two materials, or must be cut but has vertices that are only on the screen"
                )
            }
            FrameError::ClipCorner { index } => write!(
                f,
                "clip corner {index} refers to a vertex that does not exist, or does not come after both its ends and after \
                 the clip corner before"
            ),
        }
    }
}

/// A value that may have been an `f32`. It is then written with just enough digits to tell it from
/// other `f32` values.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Short(value) = *self;
        let (narrow, size) = (value as f32, value.abs());
        let is_narrow = f64::from(narrow) == value;
        // From 2²⁴ on, the shortest digits of an `f32` are not the digits of the integer that it
        // holds.
        if is_narrow && (1e-5..16_777_216.0).contains(&size) {
            write!(f, "{narrow}")
        } else if is_narrow && size > 0.0 && size.is_finite() && !(1e-5..1e16).contains(&size) {
            write!(f, "{narrow:e}")
        } else {
            Written(value).fmt(f)
        }
    }
}

impl core::error::Error for FrameError {}
