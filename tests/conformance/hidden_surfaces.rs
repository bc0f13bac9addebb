//! Visibility by depth buffers of every width, by both depth sources, and by the painter.

use crate::support;
use crate::support::{Corner, Random, add, plain_lighting, random_polygon, renderers};
use fastphong::frame::triangulate::triangulated;
use fastphong::frame::{DepthRange, Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::MeshBuilder;
use fastphong::mesh::builtin::builtin;
use fastphong::picture::Picture;
use fastphong::raster::painter_conflicts::conflicts;
use fastphong::raster::{self, Edges, NO_POLYGON};
use fastphong::reference;
use fastphong::scene::{
    Camera, Clipping, Culling, DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, PainterKey,
    Projection, Scene,
};
use fastphong::shading::Variant;
use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

fn buffer(bits: DepthBits, source: DepthSource) -> HiddenSurfaces {
    HiddenSurfaces::ZBuffer(DepthBuffer { bits, source })
}

/// Returns a torus without culling, up to four surfaces deep. A wide perspective camera stands near
/// it, an orthographic one far away.
fn torus(perspective: bool, hidden_surfaces: HiddenSurfaces) -> Frame {
    let mut scene = Scene::of_mesh(builtin("torus?segments=48&sides=24").expect("a built-in mesh"));
    (scene.width, scene.height, scene.culling) = (96, 72, Culling::None);
    if perspective {
        scene.camera.projection = Projection::Perspective { fovy: 60.0 };
        scene.camera.eye = scene.camera.target + scene.camera.view() * 2.5;
        // The near distance is no power of two, so near/w and 1/w round differently.
        (scene.camera.near, scene.camera.far) = (0.45, 5.0);
    }
    scene.hidden_surfaces = hidden_surfaces;
    scene.frame().expect("a frame")
}

/// Returns how many roundings a depth has on its way to a sample. Each step down an edge or along a
/// span rounds twice, and a picture of w × h pixels has at most w + h steps. Fewer than 32
/// roundings precede the first step.
fn roundings(frame: &Frame) -> f64 {
    2.0 * (frame.width() + frame.height()) as f64 + 32.0
}

/// Half a unit in the last place of values up to 1.
const ROUNDING: f64 = 1.0 / (1u64 << 25) as f64;

/// Both depth sources agree with each other and with the reference within rounding, under both
/// cameras.
#[test]
fn depth_per_sample_equals_interpolated_depth() {
    for perspective in [false, true] {
        let [interpolated, per_sample] = [DepthSource::Interpolated, DepthSource::PerSample]
            .map(|source| torus(perspective, buffer(DepthBits::ThirtyTwo, source)));
        // Under perspective z = f/(f−n) (1 − n/w). The rounding error of n/w, which is at most 1,
        // grows by f/(f−n). Under the orthographic camera distances reach `far`, are rounded in
        // correspondingly larger units, and are divided by f − n.
        let (near, far) = per_sample.depth_range().ends();
        let gain = far / (far - near);
        assert!(gain < 20.0, "{gain}");
        let bound = (1.0 + gain) * roundings(&per_sample) * ROUNDING;
        let (a, b) = (raster::depth(&interpolated), raster::depth(&per_sample));
        let truth = [&interpolated, &per_sample].map(|frame| reference::visibility(frame).depth);
        let mut differing = 0;
        for (i, (a, b)) in a.pixels().iter().zip(b.pixels()).enumerate() {
            assert_eq!(a.is_finite(), b.is_finite());
            if a.is_finite() {
                assert!(
                    f64::from((a - b).abs()) <= bound,
                    "{a} and {b} at pixel {i}"
                );
                differing += usize::from(a != b);
                for (found, truth) in [(a, truth[0].pixels()[i]), (b, truth[1].pixels()[i])] {
                    assert!(
                        (f64::from(*found) - truth).abs() <= bound,
                        "{found} is not {truth} at pixel {i}"
                    );
                }
            }
        }
        assert!(differing > 100, "two ways, not one: {differing} pixels");
    }
}

/// Both engines and the reference see the same polygons, with every buffer width and both depth
/// sources. Exceptions are pixels where two surfaces are closer than rounding or the buffer's
/// levels.
#[test]
fn engines_and_reference_see_the_same_polygons() {
    for perspective in [false, true] {
        for bits in [
            DepthBits::Sixteen,
            DepthBits::TwentyFour,
            DepthBits::ThirtyTwo,
        ] {
            for source in [DepthSource::Interpolated, DepthSource::PerSample] {
                let frame = torus(perspective, buffer(bits, source));
                let frame = triangulated(&frame).frame;
                let (near, far) = frame.depth_range().ends();
                let rounding = (1.0 + far / (far - near)) * roundings(&frame) * ROUNDING;
                // A depth off by e < 1/(2ᵇ − 1) is stored as the true level or a neighbouring one.
                let level = bits.most().map_or(0.0, |most| 1.0 / f64::from(most));
                let margin = 2.0 * rounding.max(if level > 0.0 { rounding + level } else { 0.0 });
                let truth = reference::visibility(&frame);
                for seen in [
                    raster::polygon_indices(&frame),
                    raster::barycentric_polygon_indices(&frame, Edges::TopLeft),
                ] {
                    let mut differing = 0;
                    for (i, (seen, expected)) in seen
                        .pixels()
                        .iter()
                        .zip(truth.polygons.pixels())
                        .enumerate()
                    {
                        if seen != expected {
                            let gap = truth.depth_gap.pixels()[i];
                            assert!(gap <= margin, "{bits:?} {source:?}: {gap} at pixel {i}");
                            differing += 1;
                        }
                    }
                    assert!(differing <= 20, "{bits:?} {source:?}: {differing} pixels");
                }
            }
        }
    }
}

/// With 16 bits, two far layers share a level at many pixels, and the first one drawn wins although
/// it is farther. Perspective spends most levels near the eye.
#[test]
fn sixteen_bits_fight_where_more_bits_do_not() {
    let apart = 0.4 / 65535.0;
    let layer = |depth: f32| -> Vec<Corner> {
        [(2, 2, 0.0), (62, 3, 2e-3), (9, 46, 1e-3)]
            .map(|(x, y, more)| Corner {
                x: x * 256,
                y: y * 256,
                depth: depth + more,
                intensity: 0.5,
            })
            .to_vec()
    };
    let seen = |bits| {
        let mut builder = FrameBuilder::new(64, 48);
        builder.hidden_surfaces(buffer(bits, DepthSource::Interpolated));
        let material = builder.lighting(plain_lighting());
        add(&mut builder, material, 0, &layer(0.99));
        add(&mut builder, material, 1, &layer((0.99 - apart) as f32));
        let frame = builder.finish().expect("a frame");
        let truth = reference::visibility(&frame).polygons;
        let count = |picture: &fastphong::picture::Picture<u32>, number| {
            picture.pixels().iter().filter(|n| **n == number).count()
        };
        let ours = raster::polygon_indices(&frame);
        assert_eq!(count(&ours, NO_POLYGON), count(&truth, NO_POLYGON));
        [&ours, &truth].map(|picture| (count(picture, 0), count(picture, 1)))
    };
    // Layers are 0.4 levels apart, so six pixels of ten show the wrong layer if fractional levels
    // are evenly distributed. They are, because depth grows by 130 levels over the triangle.
    for (farther, nearer) in seen(DepthBits::Sixteen) {
        let share = farther as f64 / (farther + nearer) as f64;
        assert!((0.55..0.65).contains(&share), "{share}");
    }
    for bits in [DepthBits::TwentyFour, DepthBits::ThirtyTwo] {
        // 102 levels of 24 bits lie between the layers. 256 roundings amount to at most 128 levels
        // per layer, and only if all have the same sign.
        assert_eq!(seen(bits).map(|(farther, _)| farther), [0, 0], "{bits:?}");
    }
}

/// The painter draws layers of constant depth as a depth buffer does, in any drawing order. The
/// reference and both engines agree to the pixel, because only the order matters.
#[test]
fn the_painter_sorts_layers_as_depth_does() {
    let mut random = Random::new(31);
    for round in 0..40 {
        let count = 3 + round % 30;
        let polygons: Vec<Vec<Corner>> = (0..count)
            .map(|_| {
                let depth = random.share();
                let corners = random_polygon(&mut random, 64, 48, 3);
                corners
                    .into_iter()
                    .map(|corner| Corner { depth, ..corner })
                    .collect()
            })
            .collect();
        let build = |how| {
            let mut builder = FrameBuilder::new(64, 48);
            builder.hidden_surfaces(how);
            let material = builder.lighting(plain_lighting());
            for (number, corners) in polygons.iter().enumerate() {
                add(&mut builder, material, number as u32, corners);
            }
            builder.finish().expect("a frame")
        };
        let sources = |frame: &Frame| {
            let source = |number: u32| {
                frame
                    .polygons()
                    .get(number as usize)
                    .map_or(NO_POLYGON, |p| p.source)
            };
            let numbers = raster::polygon_indices(frame);
            assert_eq!(
                numbers,
                reference::visibility(frame).polygons,
                "round {round}"
            );
            assert_eq!(
                numbers,
                raster::barycentric_polygon_indices(frame, Edges::TopLeft),
                "round {round}"
            );
            numbers.map(source)
        };
        let by_depth = sources(&build(HiddenSurfaces::default()));
        for key in [PainterKey::Mean, PainterKey::Farthest] {
            assert_eq!(
                sources(&build(HiddenSurfaces::Painter(key))),
                by_depth,
                "round {round}, {key:?}"
            );
        }
    }
}

/// The painter sorts by its key. A long polygon can be nearer by its mean and farther by its
/// farthest corner. Equal keys keep the drawing order.
#[test]
fn the_painters_key_decides() {
    let strip = |depths: [f32; 3]| -> Vec<Corner> {
        let [a, b, c] = depths;
        [(0, 0, a), (40, 0, b), (0, 40, c)]
            .map(|(x, y, depth)| Corner {
                x: x * 256,
                y: y * 256,
                depth,
                intensity: 0.5,
            })
            .to_vec()
    };
    let order = |first: [f32; 3], second: [f32; 3], key| {
        let mut builder = FrameBuilder::new(48, 48);
        builder.hidden_surfaces(HiddenSurfaces::Painter(key));
        let material = builder.lighting(plain_lighting());
        add(&mut builder, material, 0, &strip(first));
        add(&mut builder, material, 1, &strip(second));
        let frame = builder.finish().expect("a frame");
        let polygons = frame.polygons();
        [polygons[0].source, polygons[1].source]
    };
    let (long, level) = ([0.0, 0.1, 0.8], [0.5; 3]);
    assert_eq!(
        order(long, level, PainterKey::Mean),
        [1, 0],
        "0.3 is nearer than 0.5"
    );
    assert_eq!(
        order(long, level, PainterKey::Farthest),
        [0, 1],
        "0.8 is farther than 0.5"
    );
    assert_eq!(order(level, long, PainterKey::Mean), [0, 1]);
    for key in [PainterKey::Mean, PainterKey::Farthest] {
        assert_eq!(order(level, level, key), [0, 1]);
    }
}

/// Finds occlusion pairs by brute force: draws each polygon on its own and compares every pair
/// pixel by pixel.
fn pairs_pixel_by_pixel(frame: &Frame, alone: impl Fn(usize) -> Frame) -> Vec<(u32, u32)> {
    let depths: Vec<_> = (0..frame.polygons().len())
        .map(|i| reference::visibility(&alone(i)).depth)
        .collect();
    let hides = |a: usize, b: usize| {
        let mut both = depths[a]
            .pixels()
            .iter()
            .zip(depths[b].pixels())
            .filter(|(a, b)| a.is_finite() && b.is_finite());
        // Corners are rounded to f32, so depths a unit in the last place of 1 apart may be equal.
        both.any(|(a, b)| b - a > 1.0 / f64::from(1 << 24))
    };
    let count = depths.len();
    let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| (a, b)));
    pairs
        .filter(|&(a, b)| hides(a, b))
        .map(|(a, b)| (a as u32, b as u32))
        .collect()
}

/// Finding wrongly ordered pairs from the ends of overlapping spans gives the same pairs as
/// comparing pixels. The polygons are concave, and cross themselves and each other.
#[test]
fn wrong_pairs_agree_with_brute_force() {
    let mut random = Random::new(41);
    let (mut wrong, mut cutting) = (0, 0);
    for round in 0..30 {
        let polygons: Vec<_> = (0..12)
            .map(|i| random_polygon(&mut random, 48, 40, 3 + (i + round) % 4))
            .collect();
        let whole = support::frame(48, 40, false, &polygons);
        let found = conflicts(&whole);
        assert_eq!(
            found.wrong,
            pairs_pixel_by_pixel(&whole, |i| support::frame(48, 40, false, &polygons[i..=i]))
        );
        wrong += found.wrong.len();
        cutting += found.interpenetrating;
    }
    assert!(wrong > 100 && cutting > 20, "{wrong} {cutting}");
}

/// Returns the frame of a shipped scene at 160 × 120 with the given hidden-surface method.
fn shipped(name: &str, how: HiddenSurfaces) -> Frame {
    let mut scene = support::scene(name, Some((160, 120)));
    scene.hidden_surfaces = how;
    scene.frame().expect("a frame")
}

/// Counts the pixels where the painter shows another object than the depth buffer.
fn painted_wrong(name: &str) -> usize {
    let painted = shipped(name, HiddenSurfaces::Painter(PainterKey::Mean));
    let seen = |frame: &Frame| {
        let source = |number: u32| {
            frame
                .polygons()
                .get(number as usize)
                .map_or(NO_POLYGON, |polygon| polygon.source)
        };
        raster::polygon_indices(frame).map(source)
    };
    let (painted, buffered) = (
        seen(&painted),
        seen(&shipped(name, HiddenSurfaces::default())),
    );
    painted
        .pixels()
        .iter()
        .zip(buffered.pixels())
        .filter(|(a, b)| a != b)
        .count()
}

/// L5: *Can have unresolvable depth order*. With every key, a ring of three polygons that do not
/// cut each other is drawn wrongly, and so are polygons that cut each other. A mesh with neither is
/// drawn correctly.
#[test]
fn no_order_is_right_for_a_ring() {
    for key in [PainterKey::Mean, PainterKey::Farthest] {
        let ring = conflicts(&shipped("cyclic-triangles", HiddenSurfaces::Painter(key)));
        assert_eq!(
            (ring.cycles, ring.interpenetrating),
            (vec![vec![0, 1, 2]], 0)
        );
        assert!(
            (1..=2).contains(&ring.wrong.len()),
            "a ring of three has one or two wrong pairs in any order"
        );
        let cut = conflicts(&shipped("interpenetration", HiddenSurfaces::Painter(key)));
        assert_eq!((cut.cycles, cut.interpenetrating), (vec![vec![0, 1, 2]], 3));
    }
    assert!(painted_wrong("cyclic-triangles") > 100 && painted_wrong("interpenetration") > 100);
    let torus = conflicts(&torus_of_front_faces());
    assert_eq!(
        torus,
        Default::default(),
        "what is seen of a torus can be sorted"
    );
}

fn torus_of_front_faces() -> Frame {
    let mut scene = Scene::of_mesh(builtin("torus?segments=24&sides=12").expect("a built-in mesh"));
    (scene.width, scene.height) = (96, 72);
    scene.hidden_surfaces = HiddenSurfaces::Painter(PainterKey::Mean);
    scene.frame().expect("a frame")
}

/// The z-fighting scene fights: the floor shows through much of the star with 16 bits and nowhere
/// with 24.
#[test]
fn the_scene_of_z_fighting_fights() {
    let star = |bits| {
        let frame = shipped("z-fighting", buffer(bits, DepthSource::Interpolated));
        raster::polygon_indices(&frame)
            .pixels()
            .iter()
            .filter(|n| **n == 1)
            .count()
    };
    let (fighting, whole) = (star(DepthBits::Sixteen), star(DepthBits::TwentyFour));
    assert!(
        fighting * 10 > whole && fighting * 10 < whole * 9,
        "{fighting} of {whole} pixels"
    );
    assert_eq!(whole, star(DepthBits::ThirtyTwo));
}

/// Engines and reference agree in the z-fighting scene outside a margin. They differ only where one
/// of the two depths is so near the middle between two levels that rounding decides.
#[test]
fn fighting_is_equal_in_all_engines_outside_a_margin() {
    let fighting = support::scene("z-fighting", Some((48, 36)));
    let frame = fighting.frame().expect("a frame");
    let depths = [0, 1].map(|object| {
        let mut alone = fighting.clone();
        alone.objects = vec![fighting.objects[object].clone()];
        alone.hidden_surfaces = HiddenSurfaces::default();
        reference::visibility(&alone.frame().expect("a frame")).depth
    });
    // Each step adds an increment to a depth of ½..1 and rounds by at most 2^-25. At most 48 + 36
    // steps and fewer than 16 operations before them lead to a sample. Increments are off by 2^-24
    // of the total rise in depth, 0.02.
    let margin = (48.0 + 36.0 + 16.0 + 2.0 * 0.02 * 84.0) * ROUNDING;
    let all = depths[0].pixels().iter().filter(|z| z.is_finite());
    assert!(
        all.clone().all(|z| (0.97..0.999).contains(z)),
        "depth rises by less than 0.02 on either side"
    );
    let truth = reference::visibility(&frame).polygons;
    let is_undecided = |x: usize, y: usize| {
        depths.iter().any(|depth| {
            let levels = depth.get(x, y) * 65535.0;
            levels.is_finite() && (levels - levels.floor() - 0.5).abs() <= margin * 65535.0
        })
    };
    let (mut differing, mut decided) = (0, [0; 2]);
    for seen in [
        raster::polygon_indices(&frame),
        raster::barycentric_polygon_indices(&triangulated(&frame).frame, Edges::TopLeft),
    ] {
        let origins = triangulated(&frame).origins;
        let is_scanline = seen == raster::polygon_indices(&frame);
        for (x, y) in (0..36).flat_map(|y| (0..48).map(move |x| (x, y))) {
            let number = seen.get(x, y);
            let shown = if is_scanline || number == NO_POLYGON {
                number
            } else {
                origins[number as usize]
            };
            if is_undecided(x, y) {
                differing += usize::from(shown != truth.get(x, y));
            } else {
                assert_eq!(shown, truth.get(x, y), "at {x}, {y}");
                if let Some(count) = decided.get_mut(shown as usize) {
                    *count += 1;
                }
            }
        }
    }
    assert!(
        decided[0] > 100 && decided[1] > 10,
        "both are seen where it is decided: {decided:?}, {differing} differ"
    );
}

/// Two polygons can hide each other in the middle of their overlap, although one is outside the
/// cube at its ends. Clipping is per sample, as in CS171.
#[test]
fn conflicts_respect_per_sample_clipping() {
    let mut builder = FrameBuilder::new(48, 48);
    builder
        .clipping(Clipping::NdcCube)
        .hidden_surfaces(HiddenSurfaces::DrawOrder);
    let material = builder.lighting(plain_lighting());
    let square = |left: f32, right: f32| {
        [(4, 4, left), (44, 4, right), (44, 44, right), (4, 44, left)].map(|(x, y, depth)| Corner {
            x: x * 256,
            y: y * 256,
            depth,
            intensity: 0.5,
        })
    };
    add(&mut builder, material, 0, &square(-0.2, 1.2));
    add(&mut builder, material, 1, &square(0.3, 0.3));
    // The third square is outside the cube everywhere, so it hides nothing.
    add(&mut builder, material, 2, &square(1.5, 1.5));
    let found = conflicts(&builder.finish().expect("a frame"));
    assert_eq!((found.wrong, found.interpenetrating), (vec![(0, 1)], 1));
}

/// The painter moves a polygon's data with the polygon: a clipped polygon keeps the mean of the
/// whole one.
#[test]
fn the_painter_keeps_the_means_of_clipped_polygons() {
    let frame = |hidden_surfaces| {
        let mut scene =
            Scene::of_mesh(builtin("sphere?rings=12&segments=24").expect("a built-in mesh"));
        scene.camera.projection = Projection::Perspective { fovy: 60.0 };
        scene.camera.eye = scene.camera.target + scene.camera.view() * 2.5;
        (scene.camera.near, scene.camera.far) = (1.6, 5.0);
        (scene.culling, scene.hidden_surfaces) = (Culling::None, hidden_surfaces);
        scene.frame().expect("a frame")
    };
    let (drawn, painted) = (
        frame(HiddenSurfaces::DrawOrder),
        frame(HiddenSurfaces::Painter(PainterKey::Mean)),
    );
    assert!(drawn.stats().clipped > 10, "the near plane cuts it");
    let moved = drawn
        .polygons()
        .iter()
        .zip(painted.polygons())
        .filter(|(a, b)| a.source != b.source)
        .count();
    assert!(moved > 100, "the painter sorts");
    for polygon in painted.polygons() {
        let same = drawn
            .polygons()
            .iter()
            .find(|other| other.source == polygon.source)
            .expect("the same polygons");
        assert_eq!(
            painted.mean(polygon),
            drawn.mean(same),
            "polygon {}",
            polygon.source
        );
    }
}

/// A shape whose corners lie at random places, where several may coincide.
#[derive(Clone, Copy, Debug)]
enum Shape {
    /// A random polygon with this many corners, which may cross itself.
    Sides(usize),
    /// A polygon with a corner inside the hull of the others.
    Concave,
    /// A triangle with a fourth corner at the place of another, at another depth.
    CornerTwice,
    /// A polygon that goes to a point and returns to where it came from, at another depth.
    Spike,
    /// A polygon that crosses itself on a row of pixel centres.
    Bow,
}

const SHAPES: [Shape; 9] = [
    Shape::Sides(3),
    Shape::Sides(4),
    Shape::Sides(3),
    Shape::Sides(5),
    Shape::Sides(7),
    Shape::Concave,
    Shape::CornerTwice,
    Shape::Spike,
    Shape::Bow,
];

/// Returns the corners of a shape about `size` pixels wide in a picture `side` samples wide. Each
/// place has its own depth and its own 1/w.
fn corners_of(shape: Shape, random: &mut Random, size: u64, side: u64) -> Vec<Vertex> {
    let middle = [0; 2].map(|_| random.below(256 * side) as i32);
    // About half of the shapes have corners at pixel centres and on their rows, where crossings
    // then meet.
    let grid = [1, 128][random.below(2) as usize];
    let mut place = || {
        let moved = middle.map(|at| {
            let at = at + random.below(256 * size) as i32 - 128 * size as i32;
            at / grid * grid
        });
        Vertex {
            x: SubPixel::from_bits(moved[0]),
            y: SubPixel::from_bits(moved[1]),
            depth: f64::from(0.1 + 0.8 * random.share()),
            inv_w: f64::from(0.2 + 0.8 * random.share()),
            normal: [0.0, 0.0, 1.0],
            material: 0,
        }
    };
    let at = |place: Vertex, other: Vertex| Vertex {
        x: place.x,
        y: place.y,
        ..other
    };
    match shape {
        Shape::Sides(count) => (0..count).map(|_| place()).collect(),
        Shape::Concave => {
            let [a, b, c, d] = [place(), place(), place(), place()];
            let mean = |one: SubPixel, two: SubPixel, three: SubPixel| {
                SubPixel::from_bits((one.to_bits() + two.to_bits() + 2 * three.to_bits()) / 4)
            };
            let (x, y) = (mean(a.x, c.x, b.x), mean(a.y, c.y, b.y));
            vec![a, b, c, Vertex { x, y, ..d }]
        }
        Shape::CornerTwice => {
            let [a, b, c, d] = [place(), place(), place(), place()];
            vec![a, b, c, at(c, d)]
        }
        Shape::Spike => {
            let [a, b, c, d, e] = [place(), place(), place(), place(), place()];
            vec![a, b, c, d, at(c, e)]
        }
        Shape::Bow => {
            // The corners follow both diagonals of a square whose middle is a pixel centre.
            let half = 256 * (1 + size as i32 / 2);
            let [cx, cy] = middle.map(|at| at / 256 * 256 + 128);
            [[-1, -1], [1, 1], [-1, 1], [1, -1]]
                .map(|[x, y]| Vertex {
                    x: SubPixel::from_bits(cx + x * half),
                    y: SubPixel::from_bits(cy + y * half),
                    ..place()
                })
                .to_vec()
        }
    }
}

/// Counts the pixels that show another polygon than the first, and the pixels that show any.
fn later_ones(seen: &Picture<u32>) -> [usize; 2] {
    let covered = seen.pixels().iter().filter(|number| **number != NO_POLYGON);
    [
        covered.clone().filter(|number| **number > 0).count(),
        covered.count(),
    ]
}

/// Among polygons with the same corners the first is visible everywhere, by every engine and the
/// reference. It does not matter with which corner each begins and which way it runs, because depth
/// at a sample depends only on the corners.
#[test]
fn of_equal_polygons_the_first_is_seen_whatever_corner_each_begins_with() {
    let mut random = Random::new(29);
    let mut found: BTreeMap<String, [usize; 2]> = BTreeMap::new();
    for round in 0..360 {
        let side = 64;
        let shape = SHAPES[round % SHAPES.len()];
        // Sizes range from tiny triangles to polygons that reach beyond the picture.
        let size = [5, 14, 40, 70, 300][round / SHAPES.len() % 5];
        let [bits, source, range, samples] = [3, 2, 2, 2].map(|n| random.below(n) as usize);
        let range = [
            DepthRange::Perspective {
                near: 0.3,
                far: 7.0,
            },
            DepthRange::Orthographic {
                near: -2.0,
                far: 5.1,
            },
        ][range];
        let mut builder = FrameBuilder::new(side, side);
        builder
            .samples([1, 2][samples])
            .hidden_surfaces(buffer(
                [
                    DepthBits::Sixteen,
                    DepthBits::TwentyFour,
                    DepthBits::ThirtyTwo,
                ][bits],
                [DepthSource::Interpolated, DepthSource::PerSample][source],
            ))
            .depth_range(range);
        let [nearest, farthest] = range.depths();
        builder.lighting(plain_lighting());
        let corners: Vec<u32> = corners_of(shape, &mut random, size, u64::from(side))
            .into_iter()
            .map(|corner| {
                let depth = nearest + (farthest - nearest) * corner.depth;
                builder.vertex(Vertex { depth, ..corner })
            })
            .collect();
        // The first of them also begins with any corner and runs either way.
        let first = random.below(2 * corners.len() as u64) as usize;
        for turn in first..first + 2 * corners.len() {
            let mut turned = corners.clone();
            turned.rotate_left(turn / 2 % corners.len());
            if turn % 2 == 1 {
                turned.reverse();
            }
            builder.polygon(&turned, [0.0, 0.0, 1.0], turn as u32);
        }
        let frame = builder.finish().expect("corners inside the guard band");
        let mut count = |name: String, seen: &Picture<u32>| {
            let sum = found.entry(name).or_default();
            for (sum, more) in sum.iter_mut().zip(later_ones(seen)) {
                *sum += more;
            }
        };
        count("reference".into(), &reference::visibility(&frame).polygons);
        let cut = triangulated(&frame);
        let origin = |number: u32| cut.origins.get(number as usize).map_or(NO_POLYGON, |&o| o);
        let seen = raster::barycentric_polygon_indices(&cut.frame, Edges::TopLeft);
        count("barycentric".into(), &seen.map(origin));
        // naive-phong uses plane equations. slerp-phong uses runs, because its walk depends on the
        // previous pixel.
        for method in ["naive-phong", "slerp-phong"] {
            let variant = Variant::parse(method).expect("a method");
            for renderer in renderers::distinct(&variant, &frame) {
                let name = format!("{method}, {}", renderers::name(renderer));
                count(name, &variant.polygon_indices(&frame, renderer));
            }
        }
    }
    let covered = found.values().all(|[_, covered]| *covered > 10_000);
    assert!(covered, "pixels of later ones, and all: {found:?}");
    let none_later = found.values().all(|[later, _]| *later == 0);
    assert!(none_later, "pixels of later ones, and all: {found:?}");
}

/// Returns a scene of two walls in front of an eye at the origin, the farther one first. It is
/// wider than the nearer one, and behind it by the share `apart` of the distance.
fn walls(distance: f64, apart: f64, slope: f64) -> Scene {
    let wall = |z: f64, half: f64| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| {
            let (x, y) = (half * x * distance, half * y * distance);
            Vec3::new(x as f32, y as f32, (slope * x - z) as f32)
        })
    };
    let corners = [wall(distance * (1.0 + apart), 0.9), wall(distance, 0.1)];
    let mut builder = MeshBuilder::new(corners.concat());
    builder.polygon(&[0, 1, 2, 3]).polygon(&[4, 5, 6, 7]);
    let mut scene = Scene::of_mesh(builder.finish().expect("a mesh"));
    (scene.width, scene.height) = (80, 60);
    scene.culling = Culling::None;
    let projection = Projection::Perspective { fovy: 25.0 };
    scene.camera = Camera::looking_at(DVec3::ZERO, -DVec3::Z, projection);
    (scene.camera.near, scene.camera.far) = (1e-3, 1e6);
    scene
}

/// Returns all pictures of the visible polygons: by the reference, by the barycentric renderer, and
/// by the span and the row engine on each instruction set, along runs and by plane equations.
fn all_that_see(frame: &Frame) -> Vec<(String, Picture<u32>)> {
    let cut = triangulated(frame);
    let origin = |number: u32| cut.origins.get(number as usize).map_or(NO_POLYGON, |&o| o);
    let barycentric = raster::barycentric_polygon_indices(&cut.frame, Edges::TopLeft).map(origin);
    let mut all = vec![
        (
            "reference".to_owned(),
            reference::visibility(frame).polygons,
        ),
        ("barycentric".to_owned(), barycentric),
    ];
    for method in ["naive-phong", "slerp-phong"] {
        let variant = Variant::parse(method).expect("a method");
        for renderer in renderers::distinct(&variant, frame) {
            let name = format!("{method}, {}", renderers::name(renderer));
            all.push((name, variant.polygon_indices(frame, renderer)));
        }
    }
    all
}

/// Engines distinguish walls that are a ten-thousandth of their distance apart, anywhere between
/// near and far planes whose distances differ by a factor of 10⁹ and up to 10³⁰, and even if the
/// walls are oblique.
#[test]
fn walls_are_told_apart_at_every_distance() {
    // Set FASTPHONG_APART to find out how close is too close.
    let apart =
        std::env::var("FASTPHONG_APART").map_or(1e-4, |text| text.parse().expect("a number"));
    let far_away = [1e-3, 0.02, 1.0, 6.0, 250.0, 1e4, 8e5].map(|w| (w, 0.9e-3, 1e6));
    let very_near = [(6.0, 1e-7, 100.0), (6.0, 1e-20, 1e10), (1e4, 1e-12, 3e4)];
    for (distance, near, far) in far_away.into_iter().chain(very_near) {
        for slope in [0.0, 0.3] {
            let mut scene = walls(distance, apart, slope);
            (scene.camera.near, scene.camera.far) = (near, far);
            for source in [DepthSource::Interpolated, DepthSource::PerSample] {
                scene.hidden_surfaces = buffer(DepthBits::ThirtyTwo, source);
                let frame = scene.frame().expect("a frame");
                let mut nearer = Picture::new(frame.width(), frame.height(), NO_POLYGON);
                raster::coverage(&frame, |number, y, pixels| {
                    nearer.row_mut(y)[pixels].fill(number);
                });
                assert!(nearer.pixels().iter().filter(|n| **n == 1).count() > 500);
                for (name, seen) in all_that_see(&frame) {
                    // The barycentric renderer splits walls into triangles, which cover the same
                    // pixels.
                    let who = format!("{name} at {distance}, slope {slope}, {source:?}");
                    assert!(seen == nearer, "{who}");
                }
            }
        }
    }
}
