//! The way from a scene to a picture.

use crate::camera::{Camera, unit};
use crate::clip::{Vertex, clipped};
use crate::lighting::{Lighting, Point};
use crate::mistakes::Mistake;
use crate::normals::corners_of;
use crate::options::{
    Culling, Depth, Interpolation, Materials, NormalSign, Options, Overflow, PixelNormal, Rate,
    SamplePoint, ScreenCorners, Triangles, View, Weights,
};
use crate::picture::{Picture, Samples, picture};
use crate::placed::Placed;
use crate::raster::{Corner, Filler, Fragment};
use crate::triangulate::triangulate;
use crate::variation::{Filling, Variation};
use fastphong::mesh::Material;
use fastphong::scene::{self, DepthBits, HiddenSurfaces, Object, Scene};
use glam::DVec3;

/// Draws `scene` as a student with these `mistakes` would draw it.
///
/// Two mistakes in one step cannot be combined: see
/// [`crate::mistakes::can_be_combined`].
pub fn draw(scene: &Scene, mistakes: &[&Mistake], variation: &Variation) -> Picture {
    let mut options = Options::default();
    for mistake in mistakes {
        (mistake.make)(&mut options);
    }
    let side = if variation.supersampled { 2 } else { 1 };
    let size = [scene.width, scene.height].map(|length| length as usize * side);
    let camera = Camera::new(scene, size, &options, variation.edges);
    let mut canvas = Canvas::new(scene, size, &options, &camera, variation);
    for object in &scene.objects {
        canvas.draw(object);
    }
    picture(scene, &canvas.samples, side, &options, variation)
}

/// True if neither of two mistakes hides the other in `scene`: the picture of both differs from
/// each picture of one mistake and from the right picture.
pub fn both_show(scene: &Scene, a: &Mistake, b: &Mistake) -> bool {
    let draw = |mistakes: &[&Mistake]| draw(scene, mistakes, &Variation::default());
    let both = draw(&[a, b]);
    both != draw(&[a]) && both != draw(&[b]) && both != draw(&[])
}

/// The samples, and the data that drawing into them needs.
struct Canvas<'a> {
    scene: &'a Scene,
    options: &'a Options,
    camera: &'a Camera,
    filler: Filler,
    filling: Filling,
    samples: Samples,
    depth: Vec<f64>,
    /// Memory for the corners of a polygon in model space, and its triangles.
    cut: (Vec<DVec3>, Vec<[usize; 3]>),
    /// Memory for the corners of a piece on the screen.
    corners: Vec<Corner>,
}

impl<'a> Canvas<'a> {
    fn new(
        scene: &'a Scene,
        [width, height]: [usize; 2],
        options: &'a Options,
        camera: &'a Camera,
        variation: &Variation,
    ) -> Canvas<'a> {
        let needs_triangles = options.triangles != Triangles::Right
            || options.weights != Weights::Right
            || options.depth == Depth::OfTriangle
            || options.rate == Rate::MeanNormal;
        let filling = match variation.filling {
            Filling::ScanLines if needs_triangles => Filling::Triangles,
            filling => filling,
        };
        let start = match options.depth {
            Depth::StartsAtZero => 0.5,
            Depth::Farthest => f64::NEG_INFINITY,
            _ => f64::INFINITY,
        };
        let sample_point = match options.screen_corners {
            ScreenCorners::WholePixelsTestedThere | ScreenCorners::CutDownTestedThere => {
                SamplePoint::Corner
            }
            _ => options.sample_point,
        };
        Canvas {
            scene,
            options,
            camera,
            filler: Filler {
                width,
                height,
                edges: variation.edges,
                sample_point,
                weights: options.weights,
                box_end: options.box_end,
            },
            filling,
            samples: Samples {
                width,
                height,
                colours: vec![None; width * height],
            },
            depth: vec![start; width * height],
            cut: Default::default(),
            corners: Vec::new(),
        }
    }

    fn draw(&mut self, object: &Object) {
        let placed = Placed::new(object, self.camera, self.options);
        let mesh = placed.mesh;
        let materials = self.materials(object);
        let last = materials.len() - 1;
        let light = |material| {
            let transform = &object.transform;
            Lighting::new(self.scene, self.camera, self.options, material, transform)
        };
        let lightings: Vec<Lighting> = materials.iter().map(light).collect();
        for p in 0..mesh.polygon_count() {
            let material = mesh.polygon_material(p).unwrap_or(last).min(last);
            self.draw_polygon(&placed, &lightings[material], p);
        }
    }

    /// Returns the materials of an object. The last one is for polygons without a material.
    fn materials(&self, object: &Object) -> Vec<Material> {
        let object = match self.options.materials {
            Materials::OfFirstObject => self.scene.objects.first().unwrap_or(object),
            Materials::Own | Materials::FirstOfMesh => object,
        };
        let of_mesh = object.mesh.materials().iter().copied();
        match (object.material, self.options.materials) {
            (Some(material), _) => vec![material],
            (None, Materials::FirstOfMesh) => {
                of_mesh.chain([Material::default()]).take(1).collect()
            }
            (None, _) => of_mesh.chain([Material::default()]).collect(),
        }
    }

    fn draw_polygon(&mut self, placed: &Placed, lighting: &Lighting, p: usize) {
        let is_back = match placed.side(p) {
            0.0 => return,
            side => side < 0.0,
        };
        let is_culled = match (self.options.culling, self.scene.culling) {
            (Culling::Missing, _) | (_, scene::Culling::None) => false,
            (Culling::OfScene, scene::Culling::Back)
            | (Culling::Reversed, scene::Culling::Front) => is_back,
            (Culling::OfScene, scene::Culling::Front)
            | (Culling::Reversed, scene::Culling::Back) => !is_back,
        };
        if is_culled {
            return;
        }
        let mut vertices = placed.vertices(p);
        let mut normal = placed.polygon_normal(p);
        if is_back && self.scene.two_sided {
            normal = -normal;
            for vertex in &mut vertices {
                vertex.point.normal = -vertex.point.normal;
            }
        }
        let of_polygon = self.light_corners(lighting, &mut vertices, normal);
        if self.filling == Filling::ScanLines {
            return self.draw_piece(&vertices, lighting, of_polygon);
        }
        let start = usize::from(self.filling == Filling::OtherTriangles);
        let (mut points, mut triangles) = std::mem::take(&mut self.cut);
        corners_of(placed.mesh, p, &mut points);
        triangulate(&points, start, self.options.triangles, &mut triangles);
        for triangle in &triangles {
            self.draw_piece(&triangle.map(|i| vertices[i]), lighting, of_polygon);
        }
        self.cut = (points, triangles);
    }

    /// Computes the light at the corners of a polygon, or its single colour. If light is computed
    /// at pixels, V may still be computed at corners.
    fn light_corners(
        &self,
        lighting: &Lighting,
        vertices: &mut [Vertex],
        normal: DVec3,
    ) -> Option<DVec3> {
        match self.options.rate {
            Rate::Pixel | Rate::MeanNormal => {
                if self.options.view == View::AtVertices {
                    for vertex in vertices {
                        vertex.computed = lighting.to_eye(&vertex.point);
                    }
                }
                None
            }
            Rate::Vertex => {
                for vertex in vertices {
                    vertex.computed =
                        self.clamped(lighting.colour(&self.faced(vertex.point, lighting)));
                }
                None
            }
            Rate::FirstVertex => Some(lighting.colour(&self.faced(vertices[0].point, lighting))),
            Rate::Face => {
                let sum: DVec3 = vertices.iter().map(|vertex| vertex.point.position).sum();
                let position = sum / vertices.len() as f64;
                Some(lighting.colour(&self.faced(Point::new(position, normal), lighting)))
            }
        }
    }

    /// Returns a colour as a corner stores it: clamped to 1, unless the student clamps later or not
    /// at all.
    fn clamped(&self, colour: DVec3) -> DVec3 {
        match self.options.overflow {
            Overflow::Clamped => colour.clamp(DVec3::ZERO, DVec3::ONE),
            _ => colour,
        }
    }

    /// Returns the point with the normal that the student uses for light.
    fn faced(&self, point: Point, lighting: &Lighting) -> Point {
        let is_behind = || point.normal.dot(lighting.to_eye(&point)) < 0.0;
        match self.options.normal_sign {
            NormalSign::TowardViewer if is_behind() => Point {
                normal: -point.normal,
                ..point
            },
            _ => point,
        }
    }

    fn draw_piece(&mut self, piece: &[Vertex], lighting: &Lighting, of_polygon: Option<DVec3>) {
        let mean = || {
            let share = 1.0 / piece.len() as f64;
            let position = piece.iter().map(|v| v.point.position).sum::<DVec3>() * share;
            let normal = unit(piece.iter().map(|v| v.point.normal).sum::<DVec3>());
            lighting.colour(&self.faced(Point::new(position, normal), lighting))
        };
        let colour = match self.options.rate {
            Rate::MeanNormal => Some(mean()),
            _ => of_polygon,
        };
        let clipped = clipped(self.camera, piece);
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        corners.extend(clipped.iter().map(|v| self.project(v)));
        if self.options.depth == Depth::OfTriangle {
            let mean = corners.iter().map(|c| c.depth).sum::<f64>() / corners.len() as f64;
            corners.iter_mut().for_each(|corner| corner.depth = mean);
        }
        let (filler, filling) = (self.filler, self.filling);
        let mut put = |fragment: Fragment| self.put(fragment, lighting, colour);
        if filling == Filling::ScanLines {
            filler.polygon(&corners, &mut put);
        } else {
            for i in 2..corners.len() {
                filler.triangle([&corners[0], &corners[i - 1], &corners[i]], &mut put);
            }
        }
        self.corners = corners;
    }

    fn project(&self, vertex: &Vertex) -> Corner {
        let Vertex {
            seen,
            point,
            computed,
        } = vertex;
        let [x, y] = self.camera.screen(self.camera.device(seen));
        let w = if self.camera.is_perspective {
            seen.forward
        } else {
            1.0
        };
        let weight = match (self.options.interpolation, self.scene.interpolation) {
            (Interpolation::OnScreen, _) => 1.0,
            (Interpolation::OfScene, scene::Interpolation::Screen) => 1.0,
            (Interpolation::TimesW, _) => w,
            (Interpolation::OfScene, scene::Interpolation::Perspective) => 1.0 / w,
        };
        let (p, n, c) = (point.position, point.normal, computed);
        let carried = [p.x, p.y, p.z, n.x, n.y, n.z, c.x, c.y, c.z];
        let depth = self.camera.depth(seen.forward);
        Corner {
            x,
            y,
            depth,
            weight,
            carried,
        }
    }

    /// Draws a pixel unless a nearer one was drawn there.
    fn put(&mut self, fragment: Fragment, lighting: &Lighting, colour: Option<DVec3>) {
        let at = fragment.y * self.samples.width + fragment.x;
        let HiddenSurfaces::ZBuffer(buffer) = self.scene.hidden_surfaces else {
            panic!("no shipped scene sorts polygons");
        };
        let depth = kept(buffer.bits, fragment.depth);
        let is_visible = match self.options.depth {
            Depth::Missing => true,
            Depth::Farthest => depth > self.depth[at],
            Depth::TiesToLast => depth <= self.depth[at],
            Depth::Nearest | Depth::StartsAtZero | Depth::OfTriangle => depth < self.depth[at],
        };
        if !is_visible {
            return;
        }
        self.depth[at] = depth;
        let [px, py, pz, nx, ny, nz, cx, cy, cz] = fragment.carried;
        let position = DVec3::new(px, py, pz);
        let normal = DVec3::new(nx, ny, nz);
        let computed = DVec3::new(cx, cy, cz);
        let colour = colour.unwrap_or_else(|| match self.options.rate {
            Rate::Vertex => computed,
            _ => {
                let length = normal.dot(normal).sqrt();
                let normal = match self.options.pixel_normal {
                    PixelNormal::AsInterpolated | PixelNormal::ReflectionAlone => normal,
                    _ => normal / length,
                };
                let point = Point {
                    position,
                    normal,
                    length,
                    view: (self.options.view == View::AtVertices).then_some(computed),
                };
                lighting.colour(&self.faced(point, lighting))
            }
        });
        self.samples.colours[at] = Some(colour);
    }
}

/// Returns a depth as the depth buffer stores it.
fn kept(bits: DepthBits, depth: f64) -> f64 {
    match bits {
        DepthBits::ThirtyTwo => depth,
        DepthBits::TwentyFour => (depth * 16_777_215.0).round(),
        DepthBits::Sixteen => (depth * 65_535.0).round(),
    }
}
