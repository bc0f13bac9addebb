//! The way from world space to the screen.

use crate::options::{
    Aspect, CameraRight, CameraUp, Division, FieldOfView, HalfHeight, Options, ScreenCorners,
    ViewMatrix, Viewport,
};
use crate::variation::Edges;
use fastphong::scene::{Projection, Scene};
use glam::DVec3;

/// A point as the camera sees it: to the right, upward, and forward of the eye. The first two are
/// scaled, so that the picture ends at 1, or at `forward` under perspective.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    pub right: f64,
    pub up: f64,
    pub forward: f64,
}

/// The camera's axes, scales and screen.
pub struct Camera {
    eye: DVec3,
    axes: [DVec3; 3],
    scale: [f64; 2],
    pub is_perspective: bool,
    pub near: f64,
    pub far: f64,
    size: [f64; 2],
    view_matrix: ViewMatrix,
    division: Division,
    viewport: Viewport,
    corners: ScreenCorners,
    edges: Edges,
}

impl Camera {
    /// Makes the camera of `scene` for a picture of `size` samples.
    pub fn new(scene: &Scene, size: [usize; 2], options: &Options, edges: Edges) -> Camera {
        let camera = &scene.camera;
        let forward = unit(camera.target - camera.eye);
        let mut right = unit(forward.cross(camera.up));
        if options.camera_right == CameraRight::UpTimesForward {
            right = -right;
        }
        let up = match options.camera_up {
            // This holds for a left-handed camera too: its up vector is forward × right.
            CameraUp::Perpendicular => unit(forward.cross(camera.up)).cross(forward),
            CameraUp::AsGiven => unit(camera.up),
        };
        let [width, height] = size.map(|side| side as f64);
        Camera {
            eye: camera.eye,
            axes: [right, up, forward],
            scale: scale(camera.projection, width / height, options),
            is_perspective: matches!(camera.projection, Projection::Perspective { .. }),
            near: camera.near,
            far: camera.far,
            size: [width, height],
            view_matrix: options.view_matrix,
            division: options.division,
            viewport: options.viewport,
            corners: options.screen_corners,
            edges,
        }
    }

    /// Returns the right, upward and backward parts of a vector of world space.
    pub fn turned(&self, vector: DVec3) -> DVec3 {
        let [right, up, forward] = self.axes;
        DVec3::new(right.dot(vector), up.dot(vector), -forward.dot(vector))
    }

    /// Returns a point of world space in the camera's space: to the right, upward and backward of
    /// the eye.
    pub fn moved(&self, point: DVec3) -> DVec3 {
        self.turned(point - self.eye)
    }

    /// Returns the vector of world space whose right, upward and backward parts are `vector`.
    pub fn turned_back(&self, vector: DVec3) -> DVec3 {
        let [right, up, forward] = self.axes;
        right * vector.x + up * vector.y - forward * vector.z
    }

    /// Returns a point as the camera sees it.
    pub fn see(&self, point: DVec3) -> Seen {
        let [right, up, forward] = self.axes;
        let in_camera = match self.view_matrix {
            ViewMatrix::Right => self.turned(point - self.eye),
            ViewMatrix::Transposed => {
                let p = point - self.eye;
                right * p.x + up * p.y - forward * p.z
            }
            ViewMatrix::TranslatedLast => self.turned(point) - self.eye,
        };
        Seen {
            right: in_camera.x * self.scale[0],
            up: in_camera.y * self.scale[1],
            forward: -in_camera.z,
        }
    }

    /// Returns device coordinates, from −1 to 1 over the picture, y upward.
    pub fn device(&self, seen: &Seen) -> [f64; 2] {
        let w = match self.division {
            Division::ByW if self.is_perspective => seen.forward,
            _ => 1.0,
        };
        [seen.right / w, seen.up / w]
    }

    /// Returns pixel coordinates, from the upper left corner of the picture.
    pub fn screen(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [mut width, mut height] = self.size;
        if self.viewport == Viewport::LessOnePixel {
            (width, height) = (width - 1.0, height - 1.0);
        }
        let y = match self.viewport {
            Viewport::UpsideDown => y,
            Viewport::Right | Viewport::LessOnePixel => -y,
        };
        let point = [(x + 1.0) / 2.0 * width, (y + 1.0) / 2.0 * height];
        match self.corners {
            ScreenCorners::Exact => {}
            ScreenCorners::WholePixels | ScreenCorners::WholePixelsTestedThere => {
                return point.map(f64::round);
            }
            ScreenCorners::CutDown | ScreenCorners::CutDownTestedThere => {
                return point.map(f64::trunc);
            }
        }
        match self.edges {
            Edges::TopLeft | Edges::BottomRight => point,
            Edges::Snapped => point.map(|c| (c * 256.0).round_ties_even() / 256.0),
            Edges::Moved => [point[0] + 0.02, point[1] + 0.013],
        }
    }

    /// Returns the depth of a point `forward` of the eye: 0 at the near plane, 1 at the far one.
    pub fn depth(&self, forward: f64) -> f64 {
        let range = self.far - self.near;
        if self.is_perspective {
            self.far / range * (1.0 - self.near / forward)
        } else {
            (forward - self.near) / range
        }
    }
}

/// Returns the factors for horizontal and vertical distances.
fn scale(projection: Projection, aspect: f64, options: &Options) -> [f64; 2] {
    let mut scale = match projection {
        Projection::Orthographic { half_height } => match options.half_height {
            HalfHeight::Right => 1.0 / half_height,
            HalfHeight::TakenAsHeight => 2.0 / half_height,
        },
        Projection::Perspective { fovy } => match options.field_of_view {
            FieldOfView::Degrees => 1.0 / (fovy / 2.0).tan(),
            FieldOfView::NotHalved => 1.0 / fovy.to_radians().tan(),
            FieldOfView::Right | FieldOfView::Horizontal => 1.0 / (fovy.to_radians() / 2.0).tan(),
        },
    };
    let is_perspective = matches!(projection, Projection::Perspective { .. });
    if is_perspective && options.field_of_view == FieldOfView::Horizontal {
        scale *= aspect;
    }
    match options.aspect {
        Aspect::Right => [scale / aspect, scale],
        Aspect::Missing => [scale, scale],
        Aspect::Inverted => [scale * aspect, scale],
        Aspect::OnHeight => [scale, scale / aspect],
    }
}

/// Returns the unit vector along `vector`.
pub fn unit(vector: DVec3) -> DVec3 {
    vector / vector.dot(vector).sqrt()
}
