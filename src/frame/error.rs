//! The error of frames that cannot be made.

use super::Frame;
use crate::scene::Scene;
use core::fmt;

/// The reason why a frame could not be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FrameError {
    /// A side of the picture is 0 or over [`Scene::MAX_SIDE`].
    Size {
        /// Pixels a row.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// Samples a pixel along each side that are not 1, 2, 4 or 8, or no divisor of the frame's width and height, or too many.
    Samples {
        /// The number asked for.
        samples: u32,
    },
    /// [`Clipping::NdcCube`](crate::scene::Clipping) with
    /// [`Interpolation::Perspective`](crate::scene::Interpolation), for which corners behind the eye have no weight.
    Unclipped,
    /// More lights than [`Scene::MAX_LIGHTS`], or not as many on every material.
    Lights {
        /// The number asked for.
        found: usize,
    },
    /// A number of the light on a material is not finite, or an exponent or an attenuation is negative.
    Lighting {
        /// The number of the material.
        index: usize,
    },
    /// More corners or vertices than 32-bit numbers can name.
    TooLarge,
    /// A camera that gives no finite picture: eye at the target, up along the view, planes in the wrong order.
    Camera,
    /// Perspective interpolation where the farthest vertex is over 2⁶⁰ times as far away as the nearest.
    Weights,
    /// A vertex is outside the guard band, or a number of it is not finite, or its weight is not positive.
    Vertex {
        /// The number of the element.
        index: usize,
    },
    /// A polygon or clip corner names something that does not exist, or a polygon has fewer than three corners.
    Polygon {
        /// The number of the element.
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
            FrameError::Lighting { index } => write!(
                f,
                "the light on material {index} has a number that is not finite, or a negative exponent or attenuation"
            ),
            FrameError::TooLarge => {
                write!(f, "the scene has more corners than 32-bit numbers can name")
            }
            FrameError::Camera => write!(
                f,
                "the camera gives no picture: the eye must differ from the target, up must not be along the view, and \
                 near must be less than far (and over 0 under perspective)"
            ),
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
                    "polygon {index} has fewer than three corners, or refers to a vertex or a material that does not exist"
                )
            }
        }
    }
}

impl core::error::Error for FrameError {}
