//! The geometry of a recipe: the frame of a scene that someone with these mistakes draws.

use super::recipe::{
    Aspect, Cut, Depth, Eye, Geometry, Interpolated, Lens, Mirrored, Near, Snapping,
};
use fastphong::frame::triangulate::triangulated;
use fastphong::frame::{Frame, Polygon, PreparedScene, SubPixel};
use fastphong::scene::{
    Clipping, Culling, DepthBuffer, HiddenSurfaces, Interpolation, PainterKey, Projection, Scene,
};

/// A frame, and a flag for pictures that are turned by half a circle.
pub struct DrawnFrame {
    pub frame: Frame,
    /// True if the focal length is negative, which turns the picture by 180° around its centre.
    pub is_turned: bool,
}

/// The part of the world that the picture shows.
struct Extent {
    projection: Projection,
    /// Factors of x and y on the picture, which the projection cannot express.
    scale: [f64; 2],
    is_turned: bool,
}

impl Geometry {
    /// Makes the frame, or returns `None` if nothing can be drawn like this.
    pub fn frame(&self, prepared: &PreparedScene) -> Option<DrawnFrame> {
        let mut prepared = prepared.clone();
        let scene = prepared.settings_mut();
        if let Some(culling) = self.culling {
            scene.culling = culling;
        }
        let culling = scene.culling;
        // These mistakes cull in another way, or triangle by triangle: see `culled` below.
        let is_culled_later = self.mirrored == Mirrored::Inside || self.cut == Cut::FanOfConcave;
        if is_culled_later {
            scene.culling = Culling::None;
        }
        scene.samples = 1;
        if self.interpolation == Interpolated::Other {
            scene.interpolation = other(scene.interpolation);
        }
        match self.depth {
            Depth::Stated => {}
            // Depths are negated below. A buffer of few bits would clamp negative ones.
            Depth::Reversed => {
                scene.hidden_surfaces = HiddenSurfaces::ZBuffer(DepthBuffer::default());
            }
            Depth::TiesToLast => {}
            Depth::OfPolygons => {
                scene.hidden_surfaces = HiddenSurfaces::Painter(PainterKey::Mean);
            }
            Depth::LastInFile | Depth::FirstInFile => {
                scene.hidden_surfaces = HiddenSurfaces::DrawOrder;
            }
        }
        if self.near == Near::Divided {
            scene.clipping = Clipping::NdcCube;
        }
        let behind = scene.camera.eye - scene.camera.target;
        match (self.eye, scene.camera.projection) {
            (Eye::Behind, _) => scene.camera.eye += behind,
            (Eye::BehindByFocalLength, Projection::Perspective { fovy }) => {
                scene.camera.eye += behind.normalize_or_zero() / libm::tan(0.5 * fovy.to_radians());
            }
            _ => {}
        }
        let extent = self.extent(scene)?;
        scene.camera.projection = extent.projection;
        let mut frame = prepared.frame().ok()?;
        if self.depth == Depth::Reversed {
            let vertices = frame.vertices_mut().iter_mut();
            vertices.for_each(|vertex| vertex.depth = -vertex.depth);
        }
        if matches!(self.depth, Depth::FirstInFile | Depth::TiesToLast) {
            frame.polygons_mut().reverse();
        }
        self.place(&mut frame, extent.scale);
        let mut frame = self.cut(frame);
        if is_culled_later {
            frame = culled(frame, culling, self.mirrored);
        }
        Some(DrawnFrame {
            frame,
            is_turned: extent.is_turned,
        })
    }

    fn extent(&self, scene: &Scene) -> Option<Extent> {
        let camera = &scene.camera;
        let aspect = f64::from(scene.width) / f64::from(scene.height);
        let distance = (camera.target - camera.eye).length();
        let (mut is_perspective, mut half) = match camera.projection {
            Projection::Perspective { fovy } => {
                let tan = |share: f64| libm::tan(fovy.to_radians() * share);
                let half = match self.lens {
                    Lens::Degrees => libm::tan(fovy / 2.0),
                    Lens::WholeDegrees => libm::tan(fovy),
                    Lens::Half => tan(0.25),
                    Lens::Double => tan(1.0),
                    _ => tan(0.5),
                };
                (true, half)
            }
            Projection::Orthographic { half_height } => {
                let half = match self.lens {
                    Lens::Half => half_height / 2.0,
                    Lens::Double => half_height * 2.0,
                    _ => half_height,
                };
                (false, half)
            }
        };
        match self.lens {
            Lens::Horizontal => half /= aspect,
            Lens::OtherProjection => {
                half *= if is_perspective {
                    distance
                } else {
                    1.0 / distance
                };
                is_perspective = !is_perspective;
            }
            _ => {}
        }
        let is_turned = half < 0.0;
        half = half.abs();
        let scale = match self.aspect {
            Aspect::Stated => [1.0, 1.0],
            Aspect::Missing => [aspect, 1.0],
            Aspect::Inverted => [aspect * aspect, 1.0],
            Aspect::OnHeight => [aspect, 1.0 / aspect],
        };
        // A frame has no polygons outside its view. So make the view large enough that the frame is
        // only ever stretched.
        let least = scale[0].min(scale[1]).min(1.0);
        half /= least;
        let projection = if is_perspective {
            Projection::Perspective {
                fovy: 2.0 * libm::atan(half).to_degrees(),
            }
        } else {
            Projection::Orthographic { half_height: half }
        };
        (half.is_finite() && half > 0.0).then_some(Extent {
            projection,
            scale: scale.map(|factor| factor / least),
            is_turned,
        })
    }

    /// Moves vertices on the picture.
    fn place(&self, frame: &mut Frame, scale: [f64; 2]) {
        let samples = frame.samples() as f64;
        let size = [frame.width(), frame.height()].map(|side| side as f64);
        let is_fine = self.corners == Snapping::Fine;
        if scale == [1.0; 2] && self.halves == [0; 2] && is_fine {
            return;
        }
        let limit = f64::from(Frame::GUARD);
        let moved = |at: SubPixel, axis: usize| {
            let middle = size[axis] / 2.0;
            let shift = 0.5 * samples * f64::from(self.halves[axis]);
            let at = middle + (at.to_num::<f64>() - middle) * scale[axis] + shift;
            let at = match self.corners {
                Snapping::Fine => at,
                Snapping::WholePixels => libm::rint(at),
                Snapping::WholePixelsAtCorners => libm::rint(at) + 0.5 * samples,
                Snapping::CutDown => libm::floor(at),
                Snapping::CutDownAtCorners => libm::floor(at) + 0.5 * samples,
                Snapping::LessOne => at * (size[axis] - 1.0) / size[axis],
                Snapping::LessOneAtCorners => at * (size[axis] - 1.0) / size[axis] + 0.5 * samples,
            };
            fastphong::frame::sub_pixel(at.clamp(-limit, limit))
        };
        for vertex in frame.vertices_mut() {
            (vertex.x, vertex.y) = (moved(vertex.x, 0), moved(vertex.y, 1));
        }
    }

    /// Cuts polygons into triangles.
    fn cut(&self, frame: Frame) -> Frame {
        let frame = match self.near {
            Near::LeftOut => without_cut_polygons(&frame),
            Near::Cut | Near::Divided => frame,
        };
        match self.cut {
            Cut::Whole => frame,
            _ if frame.polygons().iter().all(|polygon| polygon.count == 3) => frame,
            Cut::Fan => fans(&frame, 0, |count| count, false),
            Cut::OtherFan => fans(&frame, 1, |count| count, false),
            Cut::Shorter => frame.with_pieces(|polygon, add| match *frame.corners(polygon) {
                [a, b, c, d] if distance(&frame, b, d) < distance(&frame, a, c) => {
                    add(&[b, c, d]);
                    add(&[b, d, a]);
                }
                ref corners => {
                    let rest = 1..corners.len() - 1;
                    rest.for_each(|i| add(&[corners[0], corners[i], corners[i + 1]]));
                }
            }),
            Cut::FanOfConcave => fans(&frame, 0, |count| count, true),
            Cut::FanWithoutLast => fans(&frame, 0, |count| count - 1, true),
            Cut::FirstTriangle => fans(&frame, 0, |_| 1, true),
            Cut::Strip => frame.with_pieces(|polygon, add| {
                frame.corners(polygon).windows(3).for_each(&mut *add);
            }),
        }
    }
}

/// Leaves out polygons that clipping cut.
fn without_cut_polygons(frame: &Frame) -> Frame {
    let is_cut = |corner: &u32| frame.clip_corner(*corner).is_some();
    frame.with_pieces(|polygon, add| {
        let corners = frame.corners(polygon);
        if !corners.iter().any(is_cut) {
            add(corners);
        }
    })
}

/// Cuts polygons into fans around the corner at index `start`. `keeps` returns how many of a fan's
/// triangles are kept. Concave polygons are cut into ears, unless `of_concave` is set.
fn fans(frame: &Frame, start: usize, keeps: fn(usize) -> usize, of_concave: bool) -> Frame {
    let cut = (!of_concave).then(|| triangulated(frame));
    let mut ears = cut
        .iter()
        .flat_map(|cut| {
            let pieces = cut.origins.iter().zip(cut.frame.polygons());
            pieces.map(|(origin, piece)| (*origin, cut.frame.corners(piece)))
        })
        .peekable();
    let mut index = 0..;
    frame.with_pieces(|polygon, add| {
        let index = index.next().unwrap_or(u32::MAX);
        let corners = frame.corners(polygon);
        let is_fan = of_concave || is_convex(frame, corners);
        while let Some((_, piece)) = ears.next_if(|(origin, _)| *origin <= index) {
            if !is_fan {
                add(piece);
            }
        }
        if is_fan {
            // Polygons of mirrored objects have their corners in reverse order.
            let is_reversed = frame.is_mirrored(polygon);
            let sides = corners.len();
            let first = if is_reversed {
                sides - 1 - start
            } else {
                start
            };
            let at = |i: usize| corners[(first + i) % sides];
            let count = sides - 2;
            let kept = if count > 1 { keeps(count) } else { count };
            let left_out = if is_reversed { count - kept } else { 0 };
            (1..=kept).for_each(|i| add(&[at(0), at(left_out + i), at(left_out + i + 1)]));
        }
    })
}

/// Leaves out polygons on the side that `culling` names. In mirrored objects `mirrored` may
/// exchange the sides.
fn culled(frame: Frame, culling: Culling, mirrored: Mirrored) -> Frame {
    let is_kept = |polygon: &Polygon| {
        let corners = frame.corners(polygon);
        let is_mirrored = frame.is_mirrored(polygon);
        // Rows grow downward, so corners run counter-clockwise where the area is negative.
        let is_turned = is_mirrored && mirrored == Mirrored::Inside;
        let is_front = (twice_area(&frame, corners) < 0) != is_turned;
        match culling {
            Culling::None => true,
            Culling::Back => is_front,
            Culling::Front => !is_front,
        }
    };
    frame.with_pieces(|polygon, add| {
        if is_kept(polygon) {
            add(frame.corners(polygon));
        }
    })
}

/// Returns the square of the distance between two vertices in space.
fn distance(frame: &Frame, a: u32, b: u32) -> f32 {
    let [a, b] = [a, b].map(|vertex| frame.position(vertex));
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum()
}

/// Returns twice the signed area of a polygon on the picture, in sub-pixels squared.
fn twice_area(frame: &Frame, corners: &[u32]) -> i64 {
    let at = |i: usize| {
        let vertex = &frame.vertices()[corners[i % corners.len()] as usize];
        [vertex.x, vertex.y].map(|c| i64::from(c.to_bits()))
    };
    let cross = |i: usize| {
        let ([ax, ay], [bx, by]) = (at(i), at(i + 1));
        ax * by - ay * bx
    };
    (0..corners.len()).map(cross).sum()
}

/// True if a polygon turns only to one side on the picture.
fn is_convex(frame: &Frame, corners: &[u32]) -> bool {
    let at = |i: usize| {
        let vertex = &frame.vertices()[corners[i % corners.len()] as usize];
        [vertex.x, vertex.y].map(|c| i64::from(c.to_bits()))
    };
    let turns = (0..corners.len()).map(|i| {
        let ([ax, ay], [bx, by], [cx, cy]) = (at(i), at(i + 1), at(i + 2));
        ((bx - ax) * (cy - by) - (by - ay) * (cx - bx)).signum()
    });
    let (mut left, mut right) = (false, false);
    for turn in turns {
        left |= turn < 0;
        right |= turn > 0;
    }
    !(left && right)
}

/// Returns the other kind of interpolation.
fn other(interpolation: Interpolation) -> Interpolation {
    match interpolation {
        Interpolation::Screen => Interpolation::Perspective,
        Interpolation::Perspective => Interpolation::Screen,
    }
}
