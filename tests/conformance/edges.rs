//! Compares values that are stepped along edges and spans with closed interpolation, on polygons of
//! any shape.

use crate::support::{Corner, Random, frame, random_polygon};
use fastphong::raster;
use fastphong::shading::Variant;

/// Returns (x, intensity) of the edges that cross the centre of a row, from left to right.
fn crossings(polygon: &[Corner], row: usize) -> Vec<(f64, f64)> {
    let centre = row as f64 * 256.0 + 128.0;
    let mut found: Vec<(f64, f64)> = (0..polygon.len())
        .filter_map(|i| {
            let (a, b) = (polygon[i], polygon[(i + 1) % polygon.len()]);
            let (top, bottom) = if a.y <= b.y { (a, b) } else { (b, a) };
            let (y1, y2) = (f64::from(top.y), f64::from(bottom.y));
            (y1 <= centre && centre < y2).then(|| {
                let t = (centre - y1) / (y2 - y1);
                let mix = |a: f64, b: f64| a + t * (b - a);
                let x = mix(f64::from(top.x), f64::from(bottom.x));
                (
                    x,
                    mix(f64::from(top.intensity), f64::from(bottom.intensity)),
                )
            })
        })
        .collect();
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found
}

/// Both ends of every span of concave polygons have the closed form's intensity: linear along the
/// two edges, then along the span (L21 3). Corner intensities are random, so a plane equation could
/// not give them.
#[test]
fn span_ends_equal_closed_edge_interpolation() {
    let gouraud = Variant::parse("gouraud").expect("a method");
    let mut random = Random::new(29);
    let mut spans = 0;
    for _ in 0..300 {
        let corners = 4 + random.below(9) as usize;
        let polygon = random_polygon(&mut random, 96, 72, corners);
        let frame = frame(96, 72, true, std::slice::from_ref(&polygon));
        let picture = gouraud
            .render_linear(&frame)
            .expect("a method for the frame");
        raster::coverage(&frame, |_, row, pixels| {
            let crossings = crossings(&polygon, row);
            assert_eq!(crossings.len() % 2, 0);
            for x in [pixels.start, pixels.end - 1] {
                let centre = x as f64 * 256.0 + 128.0;
                let near_tie = crossings.iter().any(|c| (c.0 - centre).abs() < 1e-6);
                let pair = crossings
                    .chunks_exact(2)
                    .find(|pair| pair[0].0 <= centre && centre < pair[1].0);
                let Some(&[(x1, i1), (x2, i2)]) = pair else {
                    assert!(near_tie, "a pixel outside every pair of crossings");
                    continue;
                };
                // Skip edges that cross each other within a millionth of a pixel. This test says
                // nothing about their order.
                if near_tie || crossings.windows(2).any(|w| w[1].0 - w[0].0 < 1e-6) {
                    continue;
                }
                let truth = i1 + (centre - x1) / (x2 - x1) * (i2 - i1);
                let found = f64::from(picture.get(x, row)[0]);
                // A vertex colour is off by 3 roundings. An edge of at most 72 rows and a span of
                // at most 96 pixels add one rounding per step, and as many again for their rounded
                // increments. Values are up to 1, so each rounding is 2^-25, or at most twice that
                // for a start outside the picture.
                let bound = (3.0 + 2.0 * (72.0 + 96.0)) / f64::from(1 << 24);
                assert!(
                    (found - truth).abs() <= bound,
                    "{polygon:?} at {x}, {row}: {found} is not {truth}"
                );
                spans += 1;
            }
        });
    }
    assert!(spans > 10_000, "{spans} span ends were compared");
}

/// L21 3: intensities agree along a common edge, because both polygons step it from the same corner
/// by the same steps.
#[test]
fn neighbours_agree_along_their_edge() {
    let gouraud = Variant::parse("gouraud").expect("a method");
    let corner = |x: i32, y: i32, intensity: f32| Corner {
        x: x * 256,
        y: y * 256,
        depth: 0.5,
        intensity,
    };
    // Two quads share the edge from (40, 5) to (56, 91). Their other corners are darker at the top
    // and brighter at the bottom.
    let (upper, lower) = (corner(40, 5, 0.3), corner(56, 91, 0.9));
    let left = vec![corner(3, 8, 0.3), upper, lower, corner(6, 88, 0.9)];
    let right = vec![upper, corner(92, 2, 0.3), corner(88, 95, 0.9), lower];
    let frame = frame(96, 96, true, &[left, right]);
    let picture = gouraud
        .render_linear(&frame)
        .expect("a method for the frame");
    let owners = raster::polygon_indices(&frame);
    for row in 10..85 {
        let border = (1..96)
            .find(|&x| owners.get(x - 1, row) == 0 && owners.get(x, row) == 1)
            .expect("a border");
        let (a, b) = (picture.get(border - 1, row)[0], picture.get(border, row)[0]);
        // At most one pixel lies between the last pixel of one quad and the first of the other.
        // Horizontally the intensity changes by at most 0.6 over 33 pixels where the edges are not
        // parallel.
        assert!((a - b).abs() < 0.02, "row {row}: {a} and {b}");
    }
}
