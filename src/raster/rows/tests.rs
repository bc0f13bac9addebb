//! Compares the three coverage paths with each other and with the span engine.

use super::triangles::{BATCH, SMALL_HEIGHT, SMALL_WIDTH};
use super::*;
use crate::frame::{FrameBuilder, SubPixel, Vertex};
use crate::mesh::Material;
use crate::mesh::builtin::builtin;
use crate::number::simd::{BLOCK, tests::on_each_level};
use crate::number::test_random::Random;
use crate::picture::Picture8;
use crate::raster::depth::CallersDepth;
use crate::raster::target::Target;
use crate::raster::{DrawOptions, Renderer, coverage, polygon_indices};
use crate::scene::{Light, Lighting, Scene};
use crate::shading::METHODS;
use alloc::vec;
use alloc::vec::Vec;
use glam::DVec3;

/// Builds a frame of triangles with corners in sub-pixels.
fn frame(width: usize, height: usize, triangles: &[[[i32; 2]; 3]]) -> Frame {
    let mut builder = FrameBuilder::new(width as u32, height as u32);
    let material = builder.lighting(Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z));
    for (index, triangle) in (0..).zip(triangles) {
        let corners = triangle.map(|place| {
            let [x, y] = place.map(SubPixel::from_bits);
            builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: [0.0, 0.0, 1.0],
                material,
            })
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], index);
    }
    builder.finish().expect("corners inside the guard band")
}

/// Returns triangles of all sizes, in and out of the picture. Half of them lie on a grid of
/// half-pixels, where edges hit pixel centres.
fn soup(random: &mut Random, width: usize, height: usize) -> Vec<[[i32; 2]; 3]> {
    let reaches = [3, 20, SMALL_WIDTH, SMALL_HEIGHT, 200, 20_000];
    let mut triangle = |_| {
        let grid = [1, 128][random.below(2) as usize];
        let reach = reaches[random.below(reaches.len() as u64) as usize] * 256 / grid;
        let middle =
            [width, height].map(|side| random.below(side as u64 * 256) as i32 / grid * grid);
        [(); 3].map(|()| {
            middle.map(|at| at + (random.below(reach as u64 + 1) as i32 - reach / 2) * grid)
        })
    };
    (0..150).map(&mut triangle).collect()
}

/// Pixels of two varyings, which hold the coordinates.
const TWO_VARYINGS: CellLayout = CellLayout {
    varyings: 2,
    extras: 0,
    has_uniforms: false,
};

/// A pixel (row and column) with the barycentric coordinates of the second and third corner.
type Pixel = ((usize, usize), [f32; 2]);

/// Returns the pixels that `draw` writes into an empty tile.
fn drawn<S: Token>(
    simd: S,
    (width, rows, test): (usize, &Range<usize>, SampleDepth),
    draw: impl FnOnce(&mut tile::Writer<'_, S, 0>),
) -> Vec<Pixel> {
    let mut tile = Tile::default();
    tile.prepare(HEIGHT, width, TWO_VARYINGS);
    draw(&mut tile.writer(Lanes(simd), test));
    let stride = tile.stride();
    let mut found = vec![];
    for row in rows.clone() {
        let blocks = 0..width.div_ceil(BLOCK);
        let blocks = tile.row(row - rows.start, blocks).chunks_exact(stride);
        for (block, values) in blocks.enumerate() {
            for k in (0..BLOCK).filter(|k| values[*k] != f32::INFINITY) {
                let x = block * BLOCK + k;
                assert_eq!(values[k], 0.5, "the depth");
                // Pixels beyond the picture are drawn but never shown.
                if x < width {
                    found.push(((row, x), [values[BLOCK + k], values[2 * BLOCK + k]]));
                }
            }
        }
    }
    found
}

/// Asserts that coordinates are in 0..=1, up to the error that [`SmallTriangle`] derives: 3600 ·
/// 2⁻²⁴.
#[track_caller]
fn assert_weights(pixels: &[Pixel]) {
    let out = 3600.0 / (1 << 24) as f32;
    for (place, [b, c]) in pixels {
        let is_inside = *b >= -out && *c >= -out && b + c <= 1.0 + 2.0 * out;
        assert!(is_inside, "{place:?}: {b} {c}");
    }
}

fn places(pixels: &[Pixel]) -> Vec<(usize, usize)> {
    pixels.iter().map(|(place, _)| *place).collect()
}

/// Checks every coverage path and returns how many pixels each found.
fn check<S: Token>(
    frame: &Frame,
    rows: Range<usize>,
    expected: &[Vec<(usize, usize)>],
) -> [usize; 4] {
    let (simd, width) = (S::get(), frame.width());
    let listed = |(index, polygon)| Listed {
        index,
        corners: frame.corners(polygon).try_into().expect("a triangle"),
    };
    let polygons: Vec<Listed> = (0..).zip(frame.polygons()).map(listed).collect();
    let mut rest = &polygons[..];
    let mut counts = [0; 4];
    let mut buffers = Buffers::default();
    while !rest.is_empty() {
        buffers.tile.prepare(HEIGHT, width, TWO_VARYINGS);
        let (taken, tiny, others) = find(simd, frame, rest, &rows, &mut buffers);
        assert!(taken > 0 && tiny & others == 0);
        let blocks = buffers.tile.drawn();
        let Buffers {
            batch,
            fragments,
            starts,
            ..
        } = &mut buffers;
        for k in 0..BATCH {
            // The values of a pixel are the depth and the coordinates themselves.
            batch.planes.0[k] = [[0.0; triangles::LINE]; 3];
            (
                batch.planes.0[k][0][0],
                batch.planes.0[k][1][1],
                batch.planes.0[k][2][2],
            ) = (0.5, 1.0, 1.0);
        }
        for (k, listed) in rest[..taken].iter().enumerate() {
            let expected: Vec<_> = expected[listed.index as usize]
                .iter()
                .copied()
                .filter(|(row, _)| rows.contains(row))
                .collect();
            let (m, at) = (Lanes(simd), (width, &rows, SampleDepth::new(frame)));
            if (tiny | others) >> k & 1 == 0 {
                assert_eq!(expected, [], "{listed:?}");
                continue;
            }
            let draw_large = |writer: &mut tile::Writer<'_, S, 0>| {
                runs::draw_large(m, batch, k, rows.start, writer);
            };
            // Runs find the pixels of triangles of any size.
            let mut found = vec![drawn(simd, at, draw_large)];
            let mut path = CoveragePath::Large;
            if tiny >> k & 1 == 1 {
                path = CoveragePath::Tiny;
                found.push(drawn(simd, at, |writer| {
                    fragments.draw(m, batch, k, writer)
                }));
            } else if batch.path[k] == CoveragePath::Small as i32 {
                path = CoveragePath::Small;
                found.push(drawn(simd, at, |writer| {
                    SmallTriangle::new(m, batch, k).draw(starts, rows.start, writer);
                }));
            }
            for found in &found {
                assert_weights(found);
                assert_eq!(places(found), expected, "{listed:?} as {path:?}");
                let is_inside = |&(_, x): &(usize, usize)| blocks.contains(&(x / BLOCK));
                assert!(expected.iter().all(is_inside), "{blocks:?}");
            }
            counts[path as usize] += expected.len();
        }
        rest = &rest[taken..];
    }
    counts
}

#[test]
fn tiles_cover_the_pixels_of_spans() {
    fn of<S: Token>() {
        let mut random = Random::new(23);
        let mut counts = [0; 4];
        for _ in 0..60 {
            let (width, height) = (
                1 + random.below(120) as usize,
                1 + random.below(90) as usize,
            );
            let soup = soup(&mut random, width, height);
            let frame = frame(width, height, &soup);
            let mut expected = vec![vec![]; soup.len()];
            coverage(&frame, |index, row, pixels| {
                expected[index as usize].extend(pixels.map(|x| (row, x)));
            });
            expected
                .iter_mut()
                .for_each(|pixels| pixels.sort_unstable());
            for first in (0..height).step_by(HEIGHT) {
                let rows = first..(first + HEIGHT).min(height);
                for (count, more) in counts.iter_mut().zip(check::<S>(&frame, rows, &expected)) {
                    *count += more;
                }
            }
        }
        let [_, small, large, tiny] = counts;
        let enough = small > 100_000 && large > 100_000 && tiny > 1_000;
        assert!(enough, "{small}, {large} and {tiny} pixels");
    }
    on_each_level!(of);
}

/// Vertices are lit in memory that an earlier frame left. The picture must equal the one of a
/// thread that drew nothing before.
#[test]
fn memory_that_is_kept_leaves_no_trace() {
    let Some(renderer) = Renderer::available().nth(1) else {
        return; // no SIMD
    };
    let draw = move |meshes: &[&str]| {
        let variant = Variant::parse("gouraud").expect("a method");
        let mut picture = Picture8::new(64, 48, [0; 4]);
        for mesh in meshes {
            let mut scene = Scene::of_mesh(builtin(mesh).expect("a built-in mesh"));
            (scene.width, scene.height) = (64, 48);
            let frame = scene.frame().expect("a scene in its range");
            let drawn = variant.draw(&frame, &mut picture, DrawOptions::by(renderer));
            assert_eq!(drawn, Ok(renderer));
        }
        picture
    };
    let alone = std::thread::spawn(move || draw(&["sphere?rings=8&segments=12"]));
    let after = draw(&["sphere?rings=40&segments=60", "sphere?rings=8&segments=12"]);
    assert!(after.pixels() == alone.join().expect("a picture").pixels());
}

/// Builds triangles and quadrangles of all sizes in one plane. The colour of each tells its index:
/// red is (index + 1)/256. Depths are equal but for rounding.
fn coplanar(lights: usize) -> Frame {
    let (width, height) = (100, 70);
    let mut builder = FrameBuilder::new(width, height);
    let lights = vec![Light::directional(DVec3::Z, [0.0; 3]); lights];
    for (index, triangle) in (0..).zip(soup(&mut Random::new(29), 100, 70)) {
        let ambient = [(index + 1) as f32 / 256.0, 0.0, 0.0];
        let colour = Material {
            ambient,
            ..Material::default()
        };
        let material = builder.lighting(Lighting::new(&colour, [1.0; 3], &lights, DVec3::Z));
        let mut corner = |[x, y]: [i32; 2]| {
            let depth = 0.5 + 0.7e-7 * x as f32 + 0.8e-7 * y as f32;
            let [x, y] = [x, y].map(SubPixel::from_bits);
            builder.vertex(Vertex {
                x,
                y,
                depth: depth.into(),
                inv_w: 1.0,
                normal: [0.0, 0.0, 1.0],
                material,
            })
        };
        let [a, b, c] = triangle.map(&mut corner);
        let between = [0, 1].map(|i| (triangle[0][i] + triangle[2][i]) / 2 + 300);
        let d = corner(between);
        let corners = &[a, b, c, d][..if index % 3 == 0 { 4 } else { 3 }];
        builder.polygon(corners, [0.0, 0.0, 1.0], index);
    }
    builder.finish().expect("corners inside the guard band")
}

/// With eight lights some methods interpolate more values than plane equations hold, and draw
/// triangles by runs.
#[test]
fn polygon_indices_are_those_of_the_polygons_that_each_method_shows() {
    for (lights, renderer) in [1, 8]
        .into_iter()
        .flat_map(|lights| Renderer::available().map(move |renderer| (lights, renderer)))
    {
        let frame = coplanar(lights);
        let mut found = Vec::new();
        // Methods in integers have no separate level for each polygon.
        for entry in METHODS.iter().filter(|entry| !entry.is_integer) {
            let variant = entry.variant();
            if variant.plan(&frame, renderer).renderer() != Some(renderer) {
                continue;
            }
            let picture = variant
                .render_linear_with(&frame, renderer)
                .expect("a method for the frame");
            let indices = variant.polygon_indices(&frame, renderer);
            for (pixel, index) in picture.pixels().iter().zip(indices.pixels()) {
                let shown = ((256.0 * pixel[0]).round() as u32).wrapping_sub(1);
                assert_eq!(*index, shown, "{variant} by {renderer:?}");
            }
            if !found.contains(&indices) {
                found.push(indices);
            }
        }
        // Otherwise the test would see no difference between coverage paths, or between engines.
        let is_row = renderer != Renderer::Span;
        assert_eq!(found.len(), 1 + usize::from(is_row), "{renderer:?}");
        assert_eq!(found.contains(&polygon_indices(&frame)), !is_row);
    }
}

/// A picture of levels, as a target.
struct Levels<'a>(&'a mut Picture8);

impl Target for Levels<'_> {
    fn store(&mut self, _: usize, _: usize, _: &[[f32; 3]]) {
        unreachable!("the picture takes levels");
    }
    fn levels(&mut self, row: usize) -> Option<&mut [[u8; 4]]> {
        let width = self.0.width();
        Some(&mut self.0.pixels_mut()[row * width..][..width])
    }
    fn depth(&mut self, _: usize) -> Option<CallersDepth<'_>> {
        None
    }
}

/// Draws a method on a frame as [`draw`] does, with packed colours if `packs`. Returns the picture,
/// and true if colours were packed.
fn drawn_as_levels(
    variant: &Variant,
    frame: &Frame,
    level: SimdLevel,
    packs: bool,
) -> (Picture8, bool) {
    let mut engine = RowEngine::new(variant, frame, level, 255.0, Vec::new()).expect("loops");
    if packs {
        engine.pack(vec![f32::NAN; 5]);
    }
    let (width, height) = (frame.width(), frame.height());
    let mut picture = Picture8::new(width, height, [1; 4]);
    let bins = Bins::new(frame, HEIGHT);
    let mut buffers = Buffers::default();
    for (index, first) in (0..height).step_by(HEIGHT).enumerate() {
        let band = first..(first + HEIGHT).min(height);
        let mut rows = Picture8::new(width, band.len(), [1; 4]);
        engine.fill_tile(&bins, index, &band, &mut buffers);
        for row in 0..band.len() {
            engine.shade(row, &mut buffers, &mut Levels(&mut rows));
        }
        picture.pixels_mut()[first * width..][..band.len() * width].copy_from_slice(rows.pixels());
    }
    (picture, engine.is_packed)
}

/// Returns the instruction sets of this machine that the row engine has loops for.
fn levels() -> impl Iterator<Item = SimdLevel> {
    Renderer::available().filter_map(|renderer| match renderer {
        Renderer::Row(level) => Some(level),
        _ => None,
    })
}

/// Draws triangles and quadrangles, each of its own material, in a picture whose width is not a
/// multiple of a block.
#[test]
fn packed_colours_are_those_of_unpacked_ones() {
    let frame = coplanar(1);
    for level in levels() {
        for entry in METHODS {
            let variant = entry.variant();
            if variant.plan(&frame, Renderer::Row(level)).renderer() != Some(Renderer::Row(level)) {
                continue;
            }
            let (plain, _) = drawn_as_levels(&variant, &frame, level, false);
            let (packed, is_packed) = drawn_as_levels(&variant, &frame, level, true);
            let is_by_polygon = matches!(
                entry.needs.shading_rate,
                ShadingRate::Polygon | ShadingRate::PolygonMean
            );
            assert_eq!(is_packed, is_by_polygon, "{variant}");
            assert!(plain.pixels() == packed.pixels(), "{variant} on {level:?}");
            let shown = plain.pixels().iter().filter(|[.., alpha]| *alpha == 255);
            assert!(shown.count() > 1000, "the polygons are seen");
        }
    }
}

/// A method that is lit at vertices draws all materials with the uniforms of one. Levels beyond any
/// `i32` must still be clamped, whichever material they belong to.
#[test]
fn colours_beyond_integers_are_white_beside_any_material() {
    let mut builder = FrameBuilder::new(32, 16);
    for (index, ambient) in [0.5, 1e10].into_iter().enumerate() {
        let colour = Material {
            ambient: [ambient; 3],
            ..Material::default()
        };
        let material = builder.lighting(Lighting::new(&colour, [1.0; 3], &[], DVec3::Z));
        let left = 16 * index as i32;
        let corners = [[left, 0], [left + 16, 0], [left, 16]].map(|place| {
            let [x, y] = place.map(SubPixel::from_num);
            builder.vertex(Vertex {
                x,
                y,
                depth: 0.5,
                inv_w: 1.0,
                normal: [0.0, 0.0, 1.0],
                material,
            })
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], index as u32);
    }
    let frame = builder.finish().expect("corners inside the guard band");
    for level in levels() {
        let variant = Variant::parse("gouraud-separate").expect("a method");
        let picture = variant
            .render_with(&frame, Renderer::Row(level))
            .expect("a method for the frame");
        assert_eq!(picture.get(2, 2), [128, 128, 128, 255]);
        assert_eq!(picture.get(18, 2), [255; 4]);
    }
}

/// Compares the stretches of random rows with stretches that are found pixel by pixel.
#[test]
fn stretches_have_the_uniforms_of_their_pixels() {
    let frame = coplanar(1);
    let (width, mut random) = (frame.width(), Random::new(31));
    let variant = Variant::parse("naive-phong").expect("a method");
    for level in levels() {
        let engine = RowEngine::new(&variant, &frame, level, 255.0, vec![]).expect("loops");
        assert_eq!(engine.only, None, "each polygon has a material");
        let mut tile = Tile::default();
        let mut most = 0;
        for _ in 0..400 {
            tile.prepare(HEIGHT, width, engine.cell);
            tile.extend(0..width.div_ceil(BLOCK));
            let (few, empty) = (1 + random.below(4), random.below(3));
            let mut expected = vec![None; width];
            let length = 1 + random.below(20);
            let mut last = None;
            for x in 0..tile.drawn().len() * BLOCK {
                if random.below(length) == 0 {
                    last = (random.below(3) >= empty).then(|| random.below(few) as u32);
                }
                let depth = if last.is_some() { 0.5 } else { f32::INFINITY };
                tile.set(x, CellLayout::DEPTH, depth);
                // An empty pixel still holds the index of a pixel that was drawn before.
                let index = last.unwrap_or(random.below(9) as u32);
                tile.set(x, engine.cell.uniforms(), index as f32);
                if let Some(expected) = expected.get_mut(x) {
                    *expected = last;
                }
            }
            let mut found = vec![];
            with_level!(level, S => engine.find_stretches::<S>(&tile, 0, 0..width, &mut found));
            let mut next = 0;
            for (uniforms, pixels) in &found {
                assert_eq!(pixels.start, next, "one after the other");
                next = pixels.end;
                let mut all = expected[pixels.clone()].iter().flatten();
                assert!(all.all(|index| *index == uniforms.0), "{found:?}");
            }
            assert_eq!(next, width, "all pixels");
            let mut shown: Vec<u32> = expected.iter().flatten().copied().collect();
            shown.dedup();
            assert_eq!(found.len(), shown.len().max(1), "no more than are needed");
            most = most.max(found.len());
        }
        assert!(most > 20, "{most} stretches");
    }
}

/// Builds quadrangles of all sizes and shapes, in and out of the picture, half of them on a grid of
/// half-pixels. Most are parallelograms that are bent a little; others have four corners anywhere.
/// Some have a corner twice.
fn quadrangles(random: &mut Random, [width, height]: [usize; 2], lights: usize) -> Frame {
    let mut builder = FrameBuilder::new(width as u32, height as u32);
    let lights = vec![Light::directional(DVec3::new(0.3, 0.5, 0.8), [0.7; 3]); lights];
    let materials = [0.25, 0.5].map(|red| {
        let ambient = [red, 0.1, 0.2];
        let colour = Material {
            ambient,
            ..Material::default()
        };
        builder.lighting(Lighting::new(&colour, [1.0; 3], &lights, DVec3::Z))
    });
    let reaches = [3, 8, 20, 60, 127, 140, 20_000];
    for index in 0..200 {
        let grid = [1, 128][random.below(2) as usize];
        let reach = reaches[random.below(reaches.len() as u64) as usize] * 256 / grid;
        let mut within = |reach: i32| (random.below(reach as u64 + 1) as i32 - reach / 2) * grid;
        let [u, v] = [(); 2].map(|()| [within(reach) / 2, within(reach) / 2]);
        let bent = [(); 4].map(|()| [within(reach / 8), within(reach / 8)]);
        let mut corners = [0, 1, 2, 3].map(|i: usize| {
            let [p, q] = [[-1, -1], [1, -1], [1, 1], [-1, 1]][i];
            [0, 1].map(|axis| p * u[axis] + q * v[axis] + bent[i][axis])
        });
        if random.below(3) == 0 {
            let mut within = || (random.below(reach as u64 + 1) as i32 - reach / 2) * grid;
            corners = [(); 4].map(|()| [within(), within()]);
        }
        if random.below(8) == 0 {
            corners[random.below(4) as usize] = corners[random.below(4) as usize];
        }
        let middle =
            [width, height].map(|side| random.below(side as u64 * 256) as i32 / grid * grid);
        let material = materials[random.below(2) as usize];
        let corners = corners.map(|place| {
            let [x, y] = [0, 1].map(|axis| SubPixel::from_bits(middle[axis] + place[axis]));
            let mut value = || random.below(1 << 20) as f64 / (1 << 20) as f64;
            let (depth, normal) = (value() as f32, [value(), value(), value() + 0.1]);
            let normal = DVec3::from_array(normal).normalize().as_vec3().to_array();
            builder.vertex(Vertex {
                x,
                y,
                depth: depth.into(),
                inv_w: 1.0,
                normal,
                material,
            })
        });
        builder.polygon(&corners, [0.0, 0.0, 1.0], index);
    }
    builder.finish().expect("corners inside the guard band")
}

/// Draws `frame` band by band, once as the engine does and once run by run, and compares all values
/// of the tiles.
fn assert_runs(variant: &Variant, engine: &RowEngine<'_>, bins: &Bins) {
    let (frame, mut eight, mut runs) = (engine.setup.frame, Buffers::default(), Buffers::default());
    for (index, first) in (0..frame.height()).step_by(HEIGHT).enumerate() {
        let band = first..(first + HEIGHT).min(frame.height());
        engine.fill_tile(bins, index, &band, &mut eight);
        runs.tile.prepare(HEIGHT, frame.width(), engine.cell);
        runs.queue.prepare(engine.setup.varyings.count);
        let active = &mut ActiveEdges::new(frame, &engine.setup.varyings);
        for listed in bins.band(index).flatten() {
            let queue = &mut runs.queue;
            queue.add_polygon(&engine.setup, active, listed.index, &band);
            with_level!(engine.level, S => engine.draw_runs(S::get(), &mut runs));
        }
        let (seen, all) = (eight.tile.drawn(), runs.tile.drawn());
        let is_whole = seen.start <= all.start && seen.end >= all.end;
        assert!(is_whole || all.is_empty(), "{seen:?}: {all:?} are drawn");
        for row in 0..band.len() {
            let bits = |buffers: &Buffers| -> Vec<u32> {
                let blocks = 0..frame.width().div_ceil(BLOCK);
                let values = buffers.tile.row(row, blocks).iter();
                values.map(|value| value.to_bits()).collect()
            };
            let row = first + row;
            assert!(
                bits(&eight) == bits(&runs),
                "{variant}, {:?}, row {row}",
                engine.level
            );
        }
        for row in 0..band.len() {
            eight.tile.clear_row(row);
            runs.tile.clear_row(row);
        }
    }
}

/// Quadrangles drawn eight at a time must leave the same bits in a tile as quadrangles drawn run by
/// run.
#[test]
fn quadrangles_are_those_of_runs() {
    let mut random = Random::new(37);
    let (mut drawn, mut others, mut counts) = (0, 0, Vec::new());
    for (round, level) in (0..10).flat_map(|round| levels().map(move |level| (round, level))) {
        let size = [150, 90].map(|most| 1 + random.below(most) as usize);
        let frame = quadrangles(&mut random, size, [1, 8][round % 2]);
        let bins = Bins::new(&frame, HEIGHT);
        for entry in METHODS {
            let variant = entry.variant();
            if variant.plan(&frame, Renderer::Row(level)).renderer() != Some(Renderer::Row(level)) {
                continue;
            }
            let mut engine = RowEngine::new(&variant, &frame, level, 1.0, vec![]).expect("loops");
            if engine.is_planar {
                counts.push(engine.cell.count());
                assert_runs(&variant, &engine, &bins);
            }
            engine.pack(vec![]);
            if engine.is_packed {
                counts.push(engine.cell.count());
                assert_runs(&variant, &engine, &bins);
            }
        }
        for index in 0..frame.height().div_ceil(HEIGHT) {
            let rows = index * HEIGHT..frame.height().min((index + 1) * HEIGHT);
            let polygons: Vec<Listed> = bins.band(index).flatten().copied().collect();
            for eight in polygons.chunks(BLOCK) {
                let mut quads = QuadBatch::default();
                assert_eq!(quads.gather(&frame, eight), eight.len());
                let (here, left) = with_level!(level, S => {
                    let bounded = quads.bound(Lanes(S::get()), frame.width(), &rows);
                    (bounded.drawn, bounded.others)
                });
                assert_eq!(here & left, 0, "each is drawn once");
                drawn += here.count_ones();
                others += left.count_ones();
            }
        }
    }
    assert!(drawn > 2000 && others > 1000, "{drawn} and {others}");
    let has = |count: &usize| counts.contains(count);
    assert!([2, 4, 5, 7, 14].iter().all(has), "{counts:?}");
}
