//! Pictures of interpolated attributes: vertex colours and Lecture 5's checkerboard, wrong and
//! right.

use crate::support::renderers::{name, renderers};
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::vertex_normals::NormalSource;
use fastphong::mesh::{MeshBuilder, MeshError, PolygonMesh};
use fastphong::number::{Num, Vec3 as Vector, vec3};
use fastphong::picture::LinearPicture;
use fastphong::raster::{Edges, checkerboard, vertex_colours};
use fastphong::scene::{Camera, Culling, Interpolation, Object, Projection, Scene};
use fastphong::shading::{
    Carried, Carries, Info, LightAt, Linear, MethodRow, Needs, Perspective, Shader, Span,
};
use glam::{DVec3, Vec3};
use std::sync::Arc;

#[allow(dead_code)] // its `main`
#[path = "../../examples/texture.rs"]
mod texture;

const WIDTH: usize = 96;
const HEIGHT: usize = 72;

fn camera() -> Camera {
    let projection = Projection::Perspective { fovy: 50.0 };
    let mut camera = Camera::looking_at(DVec3::new(3.0, 2.0, 9.0), DVec3::ZERO, projection);
    (camera.near, camera.far) = (1.0, 40.0);
    camera
}

fn seen(mesh: PolygonMesh, interpolation: Interpolation) -> Frame {
    scene_of(mesh, interpolation).frame().expect("a frame")
}

fn scene_of(mesh: PolygonMesh, interpolation: Interpolation) -> Scene {
    let mut object = Object::new(mesh);
    object.normals = NormalSource::Averaged.into();
    let mut scene = Scene::new(camera());
    (scene.width, scene.height) = (WIDTH as u32, HEIGHT as u32);
    scene.interpolation = interpolation;
    scene.culling = Culling::None;
    scene.objects = vec![object];
    scene
}

/// Builds a floor over −4..4 in x and z, of two triangles or one quad. Its colour is linear in x
/// and z.
fn floor(triangles: bool) -> PolygonMesh {
    let corners = [(-4.0, -4.0), (-4.0, 4.0), (4.0, 4.0), (4.0, -4.0)];
    let mut builder =
        MeshBuilder::new(corners.iter().map(|&(x, z)| Vec3::new(x, 0.0, z)).collect());
    if triangles {
        builder.polygon(&[0, 1, 2]).polygon(&[0, 2, 3]);
    } else {
        builder.polygon(&[0, 1, 2, 3]);
    }
    builder.colours(
        corners
            .iter()
            .map(|&(x, z)| colour(f64::from(x), f64::from(z)).as_vec3())
            .collect(),
    );
    builder.finish().expect("a mesh")
}

fn colour(x: f64, z: f64) -> DVec3 {
    DVec3::new(0.5 + 0.1 * x, 0.5 - 0.1 * z, 0.25 + 0.02 * (x + z))
}

/// Returns the point (x, z) where a pixel's ray meets the floor, and how far this point moves by
/// half a sub-pixel.
fn on_floor(column: usize, row: usize) -> Option<([f64; 2], f64)> {
    let camera = camera();
    let [right, up, forward] = camera.axes();
    let scale = (25.0f64).to_radians().tan();
    let at = |x: f64, y: f64| {
        let ray = forward
            + right * (2.0 * x / WIDTH as f64 - 1.0) * scale * WIDTH as f64 / HEIGHT as f64
            + up * (1.0 - 2.0 * y / HEIGHT as f64) * scale;
        let t = -camera.eye.y / ray.y;
        let p = camera.eye + t * ray;
        (t > 0.0 && p.x.abs().max(p.z.abs()) < 4.0).then_some([p.x, p.z])
    };
    let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
    let here = at(x, y)?;
    let moved = [at(x + 1.0, y)?, at(x, y + 1.0)?];
    // Corners are snapped, so they are off by up to half a sub-pixel in x and in y.
    Some((
        here,
        moved
            .iter()
            .map(|p| (p[0] - here[0]).hypot(p[1] - here[1]))
            .sum::<f64>()
            / 512.0,
    ))
}

/// Counts the pixels on the floor whose colour is not the ray's, and all compared pixels. Skips
/// pixels closer than twice the snapping error to a line of the board.
fn wrong(picture: &LinearPicture) -> (usize, usize) {
    let (mut wrong, mut all) = (0, 0);
    for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
        let Some(([wx, wz], off)) = on_floor(x, y) else {
            continue;
        };
        // Rounding coordinates to f32 moves a line by an eight-millionth of them, less than half a
        // sub-pixel.
        if [wx, wz].iter().any(|c| (c - c.round()).abs() < 2.0 * off) {
            continue;
        }
        let expected = if (wx.floor() + wz.floor()).rem_euclid(2.0) == 0.0 {
            1.0
        } else {
            0.0
        };
        wrong += usize::from(picture.get(x, y)[0] != expected);
        all += 1;
    }
    (wrong, all)
}

const BOARD: [[f32; 3]; 2] = [[1.0; 3], [0.0; 3]];

/// Lecture 5's board is correct with perspective interpolation, in both engines. Interpolated on
/// the screen it is wrong, and wrong in another way if the floor is cut into triangles.
#[test]
fn the_checkerboard_is_right_in_space_and_wrong_on_the_screen() {
    let board = |triangles, interpolation| {
        checkerboard(&seen(floor(triangles), interpolation), None, 1.0, BOARD)
    };
    for triangles in [false, true] {
        let (off, all) = wrong(&board(triangles, Interpolation::Perspective));
        assert!(off == 0 && all > 1000, "{off} of {all}");
        let (off, all) = wrong(&board(triangles, Interpolation::Screen));
        assert!(off * 5 > all, "{off} of {all} are wrong");
    }
    assert_ne!(
        board(false, Interpolation::Screen),
        board(true, Interpolation::Screen),
        "the diagonal shows"
    );
    let frame = seen(floor(true), Interpolation::Perspective);
    let by_barycentric = checkerboard(&frame, Some(Edges::TopLeft), 1.0, BOARD);
    let (off, all) = wrong(&by_barycentric);
    assert!(off == 0 && all > 1000, "{off} of {all}");
}

/// Squares have size s, and the one at the origin has colour c_1. The board is fixed to the world,
/// not to the eye.
#[test]
fn squares_have_their_size_and_place() {
    let frame = seen(floor(false), Interpolation::Perspective);
    for size in [0.5, 1.0, 3.0] {
        let picture = checkerboard(&frame, None, size, BOARD);
        let (mut wrong, mut all) = (0, 0);
        for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
            let Some(([wx, wz], off)) = on_floor(x, y) else {
                continue;
            };
            let (i, j) = (wx / size, wz / size);
            if [i, j]
                .iter()
                .any(|c| (c - c.round()).abs() * size < 2.0 * off)
            {
                continue;
            }
            let expected = if (i.floor() + j.floor()).rem_euclid(2.0) == 0.0 {
                1.0
            } else {
                0.0
            };
            wrong += usize::from(picture.get(x, y)[0] != expected);
            all += 1;
        }
        assert!(wrong == 0 && all > 800, "{size}: {wrong} of {all}");
    }
}

/// Vertex colours are interpolated linearly on the surface. Both engines draw the colour of the
/// point where each ray meets it.
#[test]
fn vertex_colours_are_linear_on_the_surface() {
    let frame = seen(floor(true), Interpolation::Perspective);
    for picture in [
        vertex_colours(&frame, None),
        vertex_colours(&frame, Some(Edges::TopLeft)),
    ] {
        let mut compared = 0;
        for (x, y) in (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| (x, y))) {
            let Some(([wx, wz], off)) = on_floor(x, y) else {
                continue;
            };
            let [r, g, b, alpha] = picture.get(x, y).map(f64::from);
            assert_eq!(alpha, 1.0, "at {x}, {y}");
            let error = (DVec3::new(r, g, b) - colour(wx, wz)).abs().max_element();
            // Colours change by 0.1 per unit, and snapped corners move the surface by `off`. About
            // 200 steps of an f32, each off by 2⁻²⁵, are divided by a weight of at least 1/14.
            assert!(error <= 0.1 * 2.0 * off + 2e-4, "{error} at {x}, {y}");
            compared += 1;
        }
        assert!(compared > 1000);
    }
    let bent = vertex_colours(&seen(floor(true), Interpolation::Screen), None);
    let straight = vertex_colours(&frame, None);
    let most = bent
        .pixels()
        .iter()
        .zip(straight.pixels())
        .map(|(a, b)| (a[0] - b[0]).abs())
        .fold(0.0, f32::max);
    assert!(
        most > 0.05,
        "linear on the screen is another picture: {most}"
    );
}

/// A mesh without colours is white. A mesh whose colours do not match its positions is rejected.
#[test]
fn a_mesh_has_one_colour_per_position_or_none() {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Z];
    let mut builder = MeshBuilder::new(triangle.to_vec());
    builder.polygon(&[0, 2, 1]);
    let mesh = builder.clone().finish().expect("a mesh");
    let picture = vertex_colours(&seen(mesh, Interpolation::Screen), None);
    assert!(picture.pixels().contains(&[1.0; 4]));
    assert!(
        picture
            .pixels()
            .iter()
            .all(|t| *t == [1.0; 4] || t[3] == 0.0)
    );
    let refused = |colours: Vec<Vec3>| {
        let mut builder = builder.clone();
        builder.colours(colours);
        builder
            .finish()
            .expect_err("colours that do not fit")
            .to_string()
    };
    assert_eq!(
        refused(vec![Vec3::ONE; 2]),
        "2 colours where 3 were expected"
    );
    assert_eq!(
        refused(vec![Vec3::ONE, Vec3::NAN, Vec3::ONE]),
        "colour 1 is not finite: expected finite numbers"
    );
}

/// A method that draws four attributes of a vertex as a colour: the first three divided by the
/// fourth.
#[derive(Clone, Copy, Default)]
struct Quotients;

static QUOTIENTS: MethodRow = MethodRow::of::<Quotients>();

impl Shader for Quotients {
    const INFO: Info = Info {
        name: "quotients",
        ..Info::OF_PIXELS
    };
    const NEEDS: Needs = Needs {
        perspective: Perspective::Divides,
        ..Needs::PIXELS
    };
    type Constants<F: Num> = ();
    type Carries = Self;
    type Walk<F: Num> = Linear<(Vector<F>, F)>;

    #[inline(always)]
    fn walk<F: Num>(self, _: &LightAt<'_, F>, span: Span<'_, Self, F>) -> Self::Walk<F> {
        span.linear()
    }
    #[inline(always)]
    fn shade<F: Num>(self, _: &LightAt<'_, F>, (v, w): (Vector<F>, F)) -> Vector<F> {
        v * (w.broadcast(1.0) / w)
    }
}

impl Carries for Quotients {
    const FROM: Carried = Carried::Attributes;
    type Varying<F: Num> = (Vector<F>, F);

    #[inline(always)]
    fn vertex<F: Num>(lit: &LightAt<'_, F>, _: Vector<F>) -> (Vector<F>, F) {
        let [x, y, z, w] = lit.attributes();
        (vec3([x, y, z]), w)
    }
}

/// A method from outside the crate draws attributes like vertex colours: linear on the surface,
/// even where the near plane cuts it. Dividing by a fourth value undoes the multiplication by it.
#[test]
fn a_method_reads_the_attributes_that_a_mesh_brings() {
    for (near, triangles) in [(1.0, true), (8.0, true), (8.0, false)] {
        let with = |attributes: Option<f32>| {
            let coloured = floor(triangles);
            let mut builder = MeshBuilder::new(coloured.positions().to_vec());
            for polygon in coloured.polygons() {
                builder.polygon(polygon);
            }
            let colours = coloured.colours();
            match attributes {
                Some(w) => {
                    let scaled = colours.iter().map(|c| *c * w);
                    builder.attributes(scaled.map(|c| [c.x, c.y, c.z, w]).collect())
                }
                None => builder.colours(colours.to_vec()),
            };
            let mut scene = scene_of(
                builder.finish().expect("a mesh"),
                Interpolation::Perspective,
            );
            scene.camera.near = near;
            scene.frame().expect("a frame")
        };
        let expected = vertex_colours(&with(None), None);
        for w in [None, Some(1.0), Some(4.0)] {
            let frame = with(w);
            assert_eq!(frame.clip_corners().is_empty(), near == 1.0);
            for renderer in renderers() {
                let picture = QUOTIENTS
                    .variant()
                    .render_linear_with(&frame, renderer)
                    .expect("a method for the frame");
                let mut covered = 0;
                for (found, expected) in picture.pixels().iter().zip(expected.pixels()) {
                    assert_eq!(found[3], expected[3]);
                    covered += usize::from(found[3] > 0.0);
                    // A colour, a weight and a fourth value are each stepped along a row and an
                    // edge. Values up to 1 are rounded twice per pixel by half of 2^-23, and
                    // divided by weights of 1/4 and more here.
                    let most = 4.0 * 3.0 * 2.0 * (WIDTH + HEIGHT) as f32 / 2.0_f32.powi(24);
                    for c in 0..3 {
                        let off = (found[c] - expected[c]).abs();
                        assert!(off <= most, "{}: {off:e} > {most:e}", name(renderer));
                    }
                }
                assert!(covered > 400, "{covered} pixels");
            }
        }
    }
}

/// A mesh has attributes at every position or none, and they do not affect other objects.
#[test]
fn a_mesh_has_four_attributes_per_position_or_none() {
    let of = |attributes: Vec<[f32; 4]>| {
        let mut builder = MeshBuilder::new(vec![Vec3::ZERO, Vec3::X, Vec3::Z]);
        builder.polygon(&[0, 2, 1]);
        if !attributes.is_empty() {
            // Attributes take the place of colours.
            builder.colours(vec![Vec3::splat(0.5); 3]);
        }
        builder.attributes(attributes);
        builder.finish()
    };
    let (found, expected) = (2, 3);
    assert_eq!(
        of(vec![[0.0; 4]; 2]).err(),
        Some(MeshError::AttributeCount { found, expected })
    );
    let wrong = vec![[0.0; 4], [f32::NAN; 4], [0.0; 4]];
    assert!(matches!(
        of(wrong).err(),
        Some(MeshError::NotFinite { index: 1, .. })
    ));

    let own = vec![[2.0, -3.0, 4.0, 5.0], [0.0; 4], [7.0; 4]];
    for normals in [NormalSource::Averaged, NormalSource::Crease(1.0)] {
        let mut scene = scene_of(of(Vec::new()).expect("a mesh"), Interpolation::Screen);
        let plain = scene.objects[0].clone();
        for mesh in [of(own.clone()).expect("a mesh"), floor(true)] {
            let mut object = plain.clone();
            object.mesh = Arc::new(mesh);
            scene.objects.push(object);
        }
        scene.objects.push(plain);
        scene
            .objects
            .iter_mut()
            .for_each(|object| object.normals = normals.into());
        scene.two_sided = true;
        let frame = scene.frame().expect("a frame");
        let vertices = frame.vertices().len() as u32;
        let attributes: Vec<[f32; 4]> = (0..vertices).map(|v| frame.attributes(v)).collect();
        let count = |four: &[f32; 4]| attributes.iter().filter(|a| *a == four).count();
        let sides = 2;
        assert_eq!(count(&[1.0; 4]), 2 * 3 * sides);
        assert!(own.iter().all(|four| count(four) == sides));
        let c = colour(-4.0, -4.0).as_vec3();
        assert!(count(&[c.x, c.y, c.z, 1.0]) >= sides);
    }

    let mut builder = FrameBuilder::new(8, 8);
    let vertex = Vertex {
        x: SubPixel::ZERO,
        y: SubPixel::ZERO,
        depth: 0.5,
        inv_w: 1.0,
        normal: [0.0, 0.0, 1.0],
        material: 0,
    };
    builder.lighting(fastphong::scene::Lighting::new(
        &Default::default(),
        [1.0; 3],
        &[],
        DVec3::Z,
    ));
    let [a, b, c] = [0; 3].map(|_| builder.vertex(vertex));
    builder.attributes(b, own[0]).colour(c, [0.5, 0.25, 0.125]);
    let frame = builder.clone().finish().expect("a frame");
    assert_eq!(
        [a, b, c].map(|v| frame.attributes(v)),
        [[1.0; 4], own[0], [0.5, 0.25, 0.125, 1.0]]
    );
    assert_eq!(frame.colour(b), [2.0, -3.0, 4.0]);
    builder.attributes(a, [0.0, 0.0, 0.0, f32::INFINITY]);
    assert!(builder.finish().is_err());
}

/// Pixels of the floor in `examples/texture.rs` have the colour of the bricks where the ray through
/// the pixel's centre meets the floor, by every renderer.
#[test]
fn a_texture_is_looked_up_where_the_ray_meets_it() {
    let scene = texture::scene().expect("a scene");
    let Projection::Perspective { fovy } = scene.camera.projection else {
        panic!("the example shows perspective");
    };
    let [right, up, forward] = scene.camera.axes();
    let reach = (fovy.to_radians() / 2.0).tan();
    // Lights and eye are far away, so light is the same everywhere on the floor: a multiple of the
    // bricks' colour, plus a highlight.
    let light = |n: DVec3| {
        let frame = scene.frame().expect("a frame");
        let lit = &frame.lightings()[frame.polygons()[0].material as usize];
        let to = scene.lights[0].place;
        let fastphong::scene::Place::Infinite(to) = to else {
            panic!("a light far away");
        };
        let l_n = to.normalize().dot(n);
        let r_v = (2.0 * l_n * n - to.normalize())
            .dot(scene.camera.view())
            .max(0.0);
        let bright = r_v.powf(f64::from(lit.shininess));
        [0, 1, 2].map(|c| {
            let one = &lit.lights[0];
            let dull = f64::from(lit.ambient[c]) + f64::from(one.diffuse[c]) * l_n;
            (dull, f64::from(one.specular[c]) * bright)
        })
    };
    let floor = light(DVec3::Y);
    let texel = |u: f64, v: f64, c: usize| {
        // Interpolated between four pixels of a repeated picture of 64 × 64.
        let place = [u, v].map(|at| at.rem_euclid(1.0) * 64.0);
        let [column, row] = place.map(|at| at.floor() as usize);
        let [a, b] = place.map(f64::fract);
        let at = |x: usize, y: usize| f64::from(texture::BRICKS[c][(y % 64) * 65 + x % 64]);
        let upper = at(column, row) * (1.0 - a) + at(column + 1, row) * a;
        let lower = at(column, row + 1) * (1.0 - a) + at(column + 1, row + 1) * a;
        upper * (1.0 - b) + lower * b
    };
    for renderer in renderers() {
        let pixels = texture::picture(renderer).expect("a picture");
        let (mut compared, mut largest, mut levels) = (0, 0.0f64, [u8::MAX, 0]);
        // The rows lie below the box, and left and right of it.
        let rows = (170..240).step_by(3);
        for (x, y) in rows.flat_map(|y| (0..320).map(move |x| (x, y))) {
            let ray = |x: f64, y: f64| {
                let [across, down] = [x - 160.0, y - 120.0].map(|at| at / 120.0 * reach);
                forward + across * right - down * up
            };
            let on_floor = |ray: DVec3| scene.camera.eye - ray * (scene.camera.eye.y / ray.y);
            let centre = [x, y].map(|at| f64::from(at) + 0.5);
            let next = on_floor(ray(centre[0] + 1.0, centre[1] + 1.0));
            let ray = ray(centre[0], centre[1]);
            let hit = on_floor(ray);
            // True if the ray is inside the box at this height above the floor.
            let is_in_box = |height: f64| {
                let at = hit + ray * (height / ray.y);
                at.x.abs() < 1.1 && at.z.abs() < 1.1
            };
            if ray.y >= 0.0 || (0..=40).any(|step| is_in_box(0.05 * f64::from(step))) {
                continue;
            }
            let found = pixels[(320 * y + x) as usize];
            levels = [levels[0].min(found[1]), levels[1].max(found[1])];
            for (c, (dull, bright)) in floor.into_iter().enumerate() {
                let colour = dull * texel(hit.x * 0.5, -hit.z * 0.5, c) + bright;
                // Rounding is off by half a level. Corners are rounded to 1/256 pixel, and places
                // in the table to 2⁻¹² after some roundings in `f32`. Neighbouring pixels of a
                // brick differ by up to 0.6 along each axis.
                let texels = 32.0 * ((next.x - hit.x).abs() + (next.z - hit.z).abs());
                let most = 0.5 + 255.0 * dull * 0.6 * (texels / 256.0 + 2f64.powi(-9));
                let off = (f64::from(found[c]) - 255.0 * colour.min(1.0)).abs();
                let who = name(renderer);
                assert!(off <= most, "{who}: {x}, {y}: {found:?}, {colour}");
                (largest, compared) = (most.max(largest), compared + 1);
            }
        }
        assert!(compared > 9000, "the test asks little: {compared} channels");
        assert!(levels[1] - levels[0] > 40, "no bricks: {levels:?}");
        assert!(largest < 3.0, "the test asks little: {largest} levels");
    }
}
