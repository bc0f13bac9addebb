//! All engines cover the same pixels as the scalar span engine, to the bit.

use crate::support::cases::cases;
use crate::support::differences::covered;
use crate::support::renderers::{name, on_threads, renderers};
use crate::support::{Corner, Random, frame, random_polygon};
use fastphong::frame::{Frame, FrameBuilder, SubPixel, Vertex};
use fastphong::mesh::Material;
use fastphong::scene::{HiddenSurfaces, Lighting};
use fastphong::shading::Variant;
use glam::DVec3;

/// Picture heights at and beside the heights of bands: 4, 8, 16 and 32 scanlines.
const HEIGHTS: [u32; 16] = [1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 31, 32, 33, 48, 65];

/// Returns a triangle along a line, a few sub-pixels wide.
fn sliver(random: &mut Random, width: i32, height: i32) -> Vec<Corner> {
    let mut at = |limit: i32| random.below(limit as u64 * 256) as i32;
    let (a, b) = ((at(width), at(height)), (at(width), at(height)));
    let along = random.below(257) as i64;
    let between = |a: i32, b: i32| a + (i64::from(b - a) * along / 256) as i32;
    let aside = |random: &mut Random| random.below(5) as i32 - 2;
    let c = (
        between(a.0, b.0) + aside(random),
        between(a.1, b.1) + aside(random),
    );
    [a, b, c]
        .map(|(x, y)| Corner {
            x,
            y,
            depth: random.share(),
            intensity: random.share(),
        })
        .to_vec()
}

/// Returns a triangle with corners far outside the picture. It covers all of the picture, a part,
/// or nothing.
fn far(random: &mut Random) -> Vec<Corner> {
    let reach = [300, 2000, 16_000][random.below(3) as usize];
    let mut corner = || {
        let mut at = || random.below(2 * reach * 256) as i32 - reach as i32 * 256;
        let (x, y) = (at(), at());
        Corner {
            x,
            y,
            depth: random.share(),
            intensity: random.share(),
        }
    };
    vec![corner(), corner(), corner()]
}

/// Returns polygons of all kinds: small triangles, slivers, triangles that reach far out, and
/// self-intersecting polygons.
fn soup(random: &mut Random, width: i32, height: i32) -> Vec<Vec<Corner>> {
    let count = 1 + random.below(90);
    let mut polygon = |_| match random.below(8) {
        0..3 => random_polygon(random, width, height, 3),
        3 => sliver(random, width, height),
        4 => far(random),
        5 => random_polygon(random, width, height, 4),
        _ => {
            let corners = 3 + random.below(14) as usize;
            random_polygon(random, width, height, corners)
        }
    };
    (0..count).map(&mut polygon).collect()
}

/// Builds a frame whose polygons have different colours, so that the picture identifies the visible
/// polygon at each pixel. That is the last one, because there is no depth test.
fn numbered(width: u32, height: u32, polygons: &[Vec<Corner>]) -> Frame {
    let mut builder = FrameBuilder::new(width, height);
    builder.hidden_surfaces(HiddenSurfaces::DrawOrder);
    for (number, corners) in polygons.iter().enumerate() {
        let shade = (number + 1) as f32 / 128.0;
        let dark = Material {
            ambient: [shade; 3],
            diffuse: [0.0; 3],
            specular: [0.0; 3],
            shininess: 1.0,
        };
        let material = builder.lighting(Lighting::new(&dark, [1.0; 3], &[], DVec3::Z));
        let place = |c: &Corner| (SubPixel::from_bits(c.x), SubPixel::from_bits(c.y));
        let vertices: Vec<u32> = corners
            .iter()
            .map(|c| {
                let (x, y) = place(c);
                builder.vertex(Vertex {
                    x,
                    y,
                    depth: c.depth.into(),
                    inv_w: 1.0,
                    normal: [0.0, 0.0, 1.0],
                    material,
                })
            })
            .collect();
        builder.polygon(&vertices, [0.0, 0.0, 1.0], number as u32);
    }
    builder.finish().expect("corners inside the guard band")
}

fn variant(name: &str) -> Variant {
    Variant::parse(name).expect("a method")
}

/// Engines see the same polygon at every pixel of random soups. Most widths of 1 to 40 pixels are
/// not whole blocks, and heights are at or beside those of bands. Flat shading uses plane equations
/// of triangles; slerp follows their edges.
#[test]
fn random_polygons_are_covered_as_in_the_lecture() {
    let mut random = Random::new(29);
    let methods = [variant("flat"), variant("slerp-phong")];
    for round in 0..320 {
        let (width, height) = (1 + random.below(40) as u32, HEIGHTS[round % HEIGHTS.len()]);
        let polygons = soup(&mut random, width as i32, height as i32);
        let last = numbered(width, height, &polygons);
        let nearest = frame(width, height, true, &polygons);
        for method in &methods {
            let (seen, drawn) = (
                method.render_linear(&last).expect("a method for the frame"),
                covered(
                    &method
                        .render_linear(&nearest)
                        .expect("a method for the frame"),
                ),
            );
            for renderer in renderers() {
                let who = || {
                    format!(
                        "round {round}: {} by {}",
                        method.info().name,
                        name(renderer)
                    )
                };
                assert_eq!(
                    method
                        .render_linear_with(&last, renderer)
                        .expect("a method for the frame"),
                    seen,
                    "{}",
                    who()
                );
                assert_eq!(
                    covered(
                        &method
                            .render_linear_with(&nearest, renderer)
                            .expect("a method for the frame")
                    ),
                    drawn,
                    "{}",
                    who()
                );
            }
        }
    }
}

/// Shipped scenes have the same coverage on one, two and three threads. The width is not a multiple
/// of a block's.
#[test]
fn shipped_scenes_are_covered_as_in_the_lecture() {
    for case in cases(Some((157, 115))) {
        let (scene, frame) = (&case.name, &case.frame);
        for method in ["flat", "slerp-phong"].map(variant) {
            let drawn = covered(&method.render_linear(frame).expect("a method for the frame"));
            assert!(drawn.pixels().iter().any(|&drawn| drawn));
            for renderer in renderers() {
                for threads in 1..=3 {
                    let ours = on_threads(threads, || {
                        covered(
                            &method
                                .render_linear_with(frame, renderer)
                                .expect("a method for the frame"),
                        )
                    });
                    let who = format!(
                        "{} on {scene} by {}, {threads} threads",
                        method.info().name,
                        name(renderer)
                    );
                    assert_eq!(ours, drawn, "{who}");
                }
            }
        }
    }
}
