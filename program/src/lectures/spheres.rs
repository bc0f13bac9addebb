//! Two spheres of the same triangles under a light that the reader moves, one by Gouraud, one by
//! fast Phong (L21 4).

use super::prelude::*;
use fastphong::mesh::{MeshBuilder, PolygonMesh};
use fastphong::picture::Picture;
use fastphong::raster::polygon_indices;
use fastphong::reference::{self, Model, Visibility};

pub(super) static FIGURE: Figure = Figure {
    name: "spheres",
    title: "Two spheres, one light",
    lecture: "L21 3 and 4: intensities or normals between the corners",
    parts: &[start, corners, meshes],
    live: Some(&LIVE),
};

pub(super) static LIVE: Live = Live {
    claim: "Gouraud shading lights the corners of each triangle and interpolates the results (L21 3). Phong shading interpolates the normals and lights each pixel (L21 4).",
    handles: &[
        Handle::fine_coordinate(["x", "sun, right"], 'x', [-1.0, 1.0], -0.4375),
        Handle::fine_coordinate(["y", "sun, up"], 'y', [-1.0, 1.0], 0.46875),
    ],
    make: |content, values| {
        let lit = Lit::new(&mut sphere(STEPS)?, toward_sun(values))?;
        lit.show(content);
        lit.conclude(content, ["gouraud", "fast-phong"]);
        Ok(())
    },
};

/// Width and height of the pictures.
const SIDE: u32 = 320;
/// How many parts each edge of the icosahedron is cut into.
const STEPS: u32 = 3;
/// Half the visible height, in radii of the sphere: the sun has room around the sphere.
const HALF_HEIGHT: f64 = 1.3;
/// The largest sine of the angle between the line of sight and the light, which keeps the light in
/// front of the sphere.
const MOST_ASIDE: f64 = 0.99;
/// A blue material. Under white light no channel is clamped, not even in the highlight.
const MATERIAL: Material = Material {
    ambient: [0.03, 0.05, 0.08],
    diffuse: [0.09, 0.25, 0.42],
    specular: [0.5; 3],
    shininess: 28.0,
};
/// The colour of the page behind the spheres.
const BACKGROUND: [f32; 3] = [11.0 / 255.0, 13.0 / 255.0, 15.0 / 255.0];

/// Returns the direction to the light from the values of the handles, its x and y. Outside the disc
/// of radius [`MOST_ASIDE`] it moves to the rim.
fn toward_sun(values: &[f64]) -> DVec3 {
    let flat = DVec2::new(values[0], values[1]).clamp_length_max(MOST_ASIDE);
    flat.extend(libm::sqrt(1.0 - flat.length_squared()))
}

/// Makes a unit sphere of triangles: an icosahedron whose edges are cut into `steps` parts.
///
/// # Errors
/// Never: the corners exist.
fn geodesic(steps: u32) -> Result<PolygonMesh> {
    // The corners of an icosahedron are those of three rectangles with golden proportions, one in
    // each coordinate plane. Index i / 4 chooses the rectangle, the two low bits the signs.
    let golden = 0.5 + libm::sqrt(1.25);
    let corner = |i: usize| {
        let sign = |bit: usize| if i & bit == 0 { 1.0 } else { -1.0 };
        let (long, short) = (sign(1) * golden, sign(2));
        [
            DVec3::new(0.0, short, long),
            DVec3::new(short, long, 0.0),
            DVec3::new(long, 0.0, short),
        ][i / 4]
    };
    let mut builder = Geodesic::default();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(corner);
                // Neighbours are 2 apart, all others farther.
                let is_face = [(p, q), (q, r), (r, p)]
                    .iter()
                    .all(|(s, t)| s.distance(*t) < 2.1);
                let is_outward = (q - p).cross(r - p).dot(p) > 0.0;
                if is_face {
                    builder.face(if is_outward { [p, q, r] } else { [p, r, q] }, steps);
                }
            }
        }
    }
    builder.finish()
}

/// A mesh under construction, whose triangles share corners.
#[derive(Default)]
struct Geodesic {
    corners: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Geodesic {
    /// Adds a face, cut into `steps`² triangles.
    fn face(&mut self, [p, q, r]: [DVec3; 3], steps: u32) {
        let mut at = |i: u32, j: u32| {
            let [i, j, k] = [i, j, steps - i - j].map(f64::from);
            self.corner((k * p + i * q + j * r).normalize())
        };
        let mut triangles = Vec::new();
        for i in 0..steps {
            for j in 0..steps - i {
                triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                if i + j + 1 < steps {
                    triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
        self.triangles.extend(triangles);
    }

    /// Returns the index of a corner, and adds it if it is new. Faces that meet there compute the
    /// same place, apart from rounding.
    fn corner(&mut self, place: DVec3) -> u32 {
        let is_here = |known: &DVec3| known.distance_squared(place) < 1e-12;
        let known = self.corners.iter().position(is_here);
        known.unwrap_or_else(|| {
            self.corners.push(place);
            self.corners.len() - 1
        }) as u32
    }

    fn finish(self) -> Result<PolygonMesh> {
        let mut builder = MeshBuilder::from_f64(&self.corners);
        for triangle in &self.triangles {
            builder.polygon(triangle);
        }
        Ok(builder.finish()?)
    }
}

/// Puts the sphere before the eye, turned so that no edge is upright.
fn sphere(steps: u32) -> Result<Scene> {
    let projection = Projection::Orthographic {
        half_height: HALF_HEIGHT,
    };
    let mut camera = Camera::looking_at(5.0 * DVec3::Z, DVec3::ZERO, projection);
    (camera.near, camera.far) = (1.0, 9.0);
    let mut scene = Scene::new(camera);
    (scene.width, scene.height) = (SIDE, SIDE);
    scene.background = BACKGROUND;
    scene.objects = Scene::of_mesh(geodesic(steps)?).objects;
    scene.objects[0].material = Some(MATERIAL);
    scene.objects[0].transform = DAffine3::from_rotation_x(0.32) * DAffine3::from_rotation_y(0.21);
    Ok(scene)
}

/// The part of a triangle where the highlight is.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Place {
    Corner,
    Edge,
    Inside,
}

/// Both spheres under one light, and the measurements at the highlight.
struct Lit {
    pictures: [LinearPicture; 2],
    /// The visible triangles, in pixels of the picture. The first one holds the highlight.
    triangles: Vec<Vec<DVec2>>,
    place: Place,
    /// How much darker than the reference Gouraud is at the brightest pixel, in grey levels, in the
    /// channel that differs most. Negative if it is brighter.
    dark: f64,
    /// How far off fast Phong is at the same pixel, in grey levels.
    off: f64,
}

impl Lit {
    /// Draws the sphere by both methods, and measures them where naive Phong is brightest.
    fn new(scene: &mut Scene, light: DVec3) -> Result<Lit> {
        scene.lights = vec![Light::directional(light, [1.0; 3])];
        let frame = scene.frame()?;
        let methods = ["gouraud", "fast-phong", "naive-phong"];
        let [gouraud, fast, naive] = draw_each(&frame, methods)?;
        let [x, y] = brightest(&naive);
        let polygon = polygon_indices(&frame).get(x, y);
        let truth = truth_at(&frame, [x, y], polygon);
        let larger = |a: f64, b: f64| if b.abs() > a.abs() { b } else { a };
        let apart = |picture: &LinearPicture| {
            let error = |c: usize| 255.0 * (truth[c] - f64::from(picture.get(x, y)[c]));
            [0, 1, 2].map(error).into_iter().fold(0.0, larger)
        };
        let mut triangles = triangles(&frame);
        if (polygon as usize) < triangles.len() {
            triangles.swap(0, polygon as usize);
        }
        let pixel = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
        Ok(Lit {
            dark: apart(&gouraud),
            off: apart(&fast).abs(),
            place: triangles.first().map_or(Place::Inside, |t| place(t, pixel)),
            triangles,
            pictures: [gouraud, fast],
        })
    }

    /// Shows both pictures, with their triangles.
    fn show(&self, content: &mut FigureContent) {
        content.row(
            "A sphere of triangles under one light",
            "Gouraud: lit at the corners | fast Phong: lit at each pixel",
            self.pictures.each_ref().map(stored),
        );
        // Round to tenths of a pixel, which nobody sees, to keep the page small.
        let short = |p: &DVec2| (10.0 * *p).round().as_vec2().to_array().map(|c| c / 10.0);
        let corners = |triangle: &Vec<DVec2>| triangle.iter().map(short).collect();
        content.outline(self.triangles.iter().map(corners).collect());
    }

    /// Says in one sentence where the highlight is, and how Gouraud draws it there.
    fn says(&self) -> String {
        let place = match self.place {
            Place::Corner => "on a corner",
            Place::Edge => "on an edge",
            Place::Inside => "inside a triangle",
        };
        let levels = written(self.dark.abs());
        let gouraud = match self.dark {
            dark if dark > ALIKE => format!("{levels} grey levels too dark there"),
            dark if dark < -ALIKE => format!("{levels} grey levels too bright there"),
            _ => format!("right within {levels} grey levels"),
        };
        format!("The highlight sits {place}: Gouraud is {gouraud}.")
    }

    /// Adds the findings at the highlight, with these keys.
    fn conclude(&self, content: &mut FigureContent, [gouraud, fast]: [&str; 2]) {
        let agreement = if self.dark > ALIKE {
            Agreement::Confirms
        } else {
            Agreement::Adds
        };
        content.found(
            &format!("{gouraud} | Gouraud where the highlight is brightest: too dark by"),
            (self.dark, "grey levels", true),
            agreement,
            &self.says(),
        );
        let says = if self.off <= 0.5 {
            "The difference is invisible."
        } else {
            "Here normals turn far from one end of a scan line to the other."
        };
        content.adds(
            &format!("{fast} | fast Phong at the same place: off by"),
            (self.off, "grey levels", true),
            says,
        );
    }
}

/// The largest error in grey levels with which Gouraud counts as right at the highlight.
const ALIKE: f64 = 4.0;

/// Returns the corners of all polygons of a frame, in pixels of the picture.
fn triangles(frame: &Frame) -> Vec<Vec<DVec2>> {
    let place = |i: &u32| {
        let vertex = &frame.vertices()[*i as usize];
        DVec2::new(vertex.x.to_num(), vertex.y.to_num())
    };
    let polygons = frame.polygons().iter();
    polygons
        .map(|polygon| frame.corners(polygon).iter().map(place).collect())
        .collect()
}

/// Returns the column and row of the brightest pixel, where the sum of the channels is largest.
fn brightest(picture: &LinearPicture) -> [usize; 2] {
    let bright = |pixel: &[f32; 4]| pixel[3] * (pixel[0] + pixel[1] + pixel[2]);
    let all = picture.pixels().iter().map(bright).enumerate();
    let most = all.fold(
        (0, -1.0),
        |most, here| if here.1 > most.1 { here } else { most },
    );
    [most.0 % picture.width(), most.0 / picture.width()]
}

/// Returns the reference's colour of one pixel, which shows `polygon`. Only this pixel is shaded,
/// which is much faster than a whole picture.
fn truth_at(frame: &Frame, [x, y]: [usize; 2], polygon: u32) -> [f64; 4] {
    let empty = |value| Picture::new(frame.width(), frame.height(), value);
    let mut polygons = Picture::new(frame.width(), frame.height(), Visibility::NONE);
    polygons.row_mut(y)[x] = polygon;
    let seen = Visibility {
        polygons,
        depth: empty(f64::INFINITY),
        depth_gap: empty(f64::INFINITY),
    };
    reference::shade(frame, &seen, Model::Phong)
        .picture
        .get(x, y)
}

/// Returns the part of a triangle where a point is, by its barycentric coordinates.
fn place(triangle: &[DVec2], point: DVec2) -> Place {
    let &[a, b, c] = triangle else {
        return Place::Inside;
    };
    let area = (b - a).perp_dot(c - a);
    let weights = [(b, c), (c, a), (a, b)].map(|(p, q)| (p - point).perp_dot(q - point) / area);
    let [least, most] = [f64::min, f64::max].map(|pick| weights.into_iter().reduce(pick));
    match (least, most) {
        (_, Some(most)) if most > 0.85 => Place::Corner,
        (Some(least), _) if least < 0.12 => Place::Edge,
        _ => Place::Inside,
    }
}

/// Shows the spheres with the light where the page starts, and measures the highlight.
fn start(content: &mut FigureContent) -> Result {
    content.text(
        "Both spheres have the same triangles, the same normals at the corners, and the same light. \
         Gouraud's method computes light at the corners only. It loses a highlight that falls between \
         them. If the highlight falls on a corner, it draws it as wide as the triangles around the corner.",
    );
    let start: Vec<f64> = LIVE.handles.iter().map(|handle| handle.start).collect();
    let lit = Lit::new(&mut sphere(STEPS)?, toward_sun(&start))?;
    lit.show(content);
    lit.conclude(content, ["inside", "inside-fast"]);
    Ok(())
}

/// Turns the light until the highlight falls on a corner.
fn corners(content: &mut FigureContent) -> Result {
    // The corner of the icosahedron that faces the eye most.
    let frame = sphere(1)?.frame()?;
    let normals = (0..frame.vertices().len() as u32)
        .map(|i| DVec3::from_array(frame.normal(i).map(f64::from)));
    let nearest = normals
        .max_by(|a, b| a.z.total_cmp(&b.z))
        .unwrap_or(DVec3::Z);
    // From this direction light is reflected at the corner to the eye.
    let light = 2.0 * nearest.z * nearest - DVec3::Z;
    let lit = Lit::new(&mut sphere(STEPS)?, light.normalize())?;
    lit.show(content);
    lit.conclude(content, ["corner", "corner-fast"]);
    Ok(())
}

/// Moves the light over a grid of directions, on four spheres with more and more triangles.
fn meshes(content: &mut FigureContent) -> Result {
    const GRID: i32 = 2;
    let mut rows = Vec::new();
    let (mut worst, mut loss) = (0.0f64, Vec::new());
    for steps in [2, 3, 6, 12] {
        let (mut scene, mut dark) = (sphere(steps)?, Vec::new());
        for i in -GRID..=GRID {
            for j in -GRID..=GRID {
                let values = [i, j].map(|v| 0.7 * f64::from(v) / f64::from(GRID));
                let lit = Lit::new(&mut scene, toward_sun(&values))?;
                worst = worst.max(lit.off);
                dark.push(lit.dark);
            }
        }
        let mean = dark.iter().sum::<f64>() / dark.len() as f64;
        let most = largest(dark);
        rows.push(format!(
            "{} | {} | {}",
            20 * steps * steps,
            written(mean),
            written(most)
        ));
        loss.push(mean);
    }
    content.table(
        "triangles | Gouraud at the highlight: levels too dark, mean over 25 lights | at most",
        rows,
    );
    content.confirms(
        "mean | Gouraud at the highlight, mean over 25 lights: too dark by",
        (loss[1], "grey levels", loss[1] > 10.0),
        "Gouraud blurs the highlight, but less on finer meshes.",
    );
    content.adds(
        "fast | fast Phong at the highlight, on four meshes under 25 lights: off by at most",
        (worst, "grey levels", worst < 0.5),
        "The difference is invisible.",
    );
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::split_mix::SplitMix;

    #[test]
    fn the_sphere_is_closed_and_its_corners_are_shared() {
        for steps in 1..=4 {
            let mesh = geodesic(steps).expect("a mesh");
            assert_eq!(mesh.polygon_count(), 20 * (steps * steps) as usize);
            // Euler: corners − edges + triangles = 2, with three half edges a triangle.
            assert_eq!(mesh.positions().len(), mesh.polygon_count() / 2 + 2);
            for triangle in mesh.polygons() {
                let [p, q, r] = [0, 1, 2].map(|i| mesh.positions()[triangle[i] as usize]);
                assert!((q - p).cross(r - p).dot(p) > 0.0, "{triangle:?}");
            }
        }
    }

    #[test]
    fn a_point_is_on_a_corner_on_an_edge_or_inside() {
        let triangle = [DVec2::ZERO, DVec2::new(10.0, 0.0), DVec2::new(0.0, 10.0)];
        let at = |x, y| place(&triangle, DVec2::new(x, y));
        assert_eq!([at(0.5, 0.5), at(9.0, 0.5)], [Place::Corner; 2]);
        assert_eq!([at(5.0, 0.5), at(4.8, 4.8)], [Place::Edge; 2]);
        assert_eq!(at(3.0, 3.0), Place::Inside);
    }

    /// The values measured at one pixel are the differences of whole pictures there, and the
    /// sentence states them.
    #[test]
    fn the_sentence_is_true_wherever_the_sun_is() {
        let mut random = SplitMix(44);
        let mut scene = sphere(STEPS).expect("a scene");
        for _ in 0..40 {
            let values = [random.next(), random.next()]
                .map(|bits| (bits >> 11) as f64 / (1u64 << 52) as f64 - 1.0);
            let lit = Lit::new(&mut scene, toward_sun(&values)).expect("pictures");
            let frame = scene.frame().expect("a frame");
            let exact = truth(&frame);
            let [x, y] = brightest(&draw(&frame, "naive-phong").expect("a picture"));
            let [most, here] = [brightest(&exact), [x, y]].map(|[x, y]| exact.get(x, y)[2]);
            assert!(255.0 * (most - here) < 0.1, "{values:?}");
            let levels = |picture: &LinearPicture| {
                [0, 1, 2].map(|c| 255.0 * f64::from(exact.get(x, y)[c] - picture.get(x, y)[c]))
            };
            let [gouraud, fast] = lit.pictures.each_ref().map(levels);
            let close = |a: f64, b: f64| (a - b).abs() < 0.02;
            assert!(gouraud.iter().any(|e| close(*e, lit.dark)), "{values:?}");
            assert!(fast.iter().any(|e| close(e.abs(), lit.off)), "{values:?}");
            let says = lit.says();
            assert_eq!(says.contains("too dark"), lit.dark > ALIKE, "{says}");
            assert_eq!(
                says.contains("right within"),
                lit.dark.abs() <= ALIKE,
                "{says}"
            );
            assert!(says.contains(&written(lit.dark.abs())), "{says}");
        }
    }
}
