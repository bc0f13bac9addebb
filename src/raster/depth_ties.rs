//! Depth ties: samples at which rounding decides which of two polygons is seen; and doubled faces.

use super::setup::Varyings;
use super::spans::{NO_POLYGON, scan};
use crate::frame::{Frame, Polygon, ScreenVertex, SubPixel};
use crate::raster::depth::SampleDepth;
use alloc::vec;
use alloc::vec::Vec;

/// How many samples of a frame the depth test cannot decide.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DepthTies {
    /// The samples that some polygon covers.
    pub covered: usize,
    /// The samples at which the visible polygon and another one are equally near within rounding.
    /// Engines may show either.
    pub samples: usize,
    /// The polygons that tie at some sample.
    pub polygons: usize,
    /// Polygons with the same corners as an earlier one, which is seen in their place. Rounding
    /// does not decide between these.
    pub doubled: usize,
}

/// How many roundings of a depth are allowed for on its way to a sample: at the corner, the edge,
/// the span and their steps. Each is half a unit in the last place of the polygon's largest depth.
/// The worst case grows with the size of the picture. But the errors of steps have either sign, so
/// their sum stays far below.
const ROUNDINGS: f32 = 16.0;

/// How uncertain a polygon's depth is, and what the search has found out about the polygon.
#[derive(Clone, Copy, Debug, Default)]
struct Uncertainty {
    /// How far a depth may be off.
    depth: f32,
    /// True once the polygon tied at some sample.
    is_tied: bool,
    /// True once an equal polygon hid this one.
    is_doubled: bool,
}

/// Counts the samples of `frame` at which rounding decides the depth test.
///
/// Two depths tie if they differ by less than the sum of their uncertainties. A depth is uncertain
/// by rounding, and by its growth over 1/256 pixel, to which corners are snapped. Where depth is
/// stored as levels, equal levels tie. A frame that is drawn without a depth test has no ties.
///
/// It takes the time of finding the spans and of looking at each of their samples once more.
pub fn depth_ties(frame: &Frame) -> DepthTies {
    let rule = SampleDepth::new(frame);
    let mut ties = DepthTies::default();
    if !rule.hides {
        return ties;
    }
    let mut polygons: Vec<Uncertainty> = frame
        .polygons()
        .iter()
        .map(|polygon| Uncertainty {
            depth: uncertainty(frame, polygon, rule),
            ..Uncertainty::default()
        })
        .collect();
    let mut is_tied = vec![false; frame.width()];
    // The last pair that was compared, because most samples meet the pair of the sample before.
    let mut equal = ((NO_POLYGON, NO_POLYGON), false);
    scan(frame, &Varyings::none(), &mut |_, line, _| {
        is_tied.fill(false);
        let line = line.drawn();
        for span in line.spans {
            let (polygon, mut q) = (span.polygon, span.depth);
            for x in span.start..span.end {
                let seen = line.polygon(x as usize);
                if seen != polygon && seen != NO_POLYGON {
                    let gap = (rule.stored(q) - line.stored(x as usize)).abs();
                    let [here, there] = [polygon, seen].map(|p| polygons[p as usize].depth);
                    if gap <= here + there {
                        if equal.0 != (polygon, seen) {
                            equal = ((polygon, seen), are_equal(frame, [polygon, seen]));
                        }
                        if equal.1 {
                            polygons[polygon.max(seen) as usize].is_doubled = true;
                        } else {
                            is_tied[x as usize] = true;
                            polygons[polygon as usize].is_tied = true;
                            polygons[seen as usize].is_tied = true;
                        }
                    }
                }
                q += span.depth_step;
            }
        }
        ties.samples += is_tied.iter().filter(|is_tied| **is_tied).count();
        let covered = (0..frame.width()).filter(|x| line.polygon(*x) != NO_POLYGON);
        ties.covered += covered.count();
    });
    ties.polygons = polygons.iter().filter(|p| p.is_tied).count();
    ties.doubled = polygons.iter().filter(|p| p.is_doubled).count();
    ties
}

/// Returns how far a polygon's stored depth may be off at a sample.
fn uncertainty(frame: &Frame, polygon: &Polygon, rule: SampleDepth) -> f32 {
    if rule.most.is_some() {
        return 0.0;
    }
    let corners = || {
        let corners = frame.corners(polygon).iter();
        corners.map(|&v| &frame.vertices()[v as usize])
    };
    let at = |v: &ScreenVertex| {
        let [x, y] = [v.x, v.y].map(|c| c.to_num::<f64>());
        [x, y, f64::from(rule.stored(rule.of_corner(v)))]
    };
    // Newell's formula on the screen: the normal of the plane z = depth over x and y.
    let mut normal = [0.0f64; 3];
    let (mut low, mut high, mut largest) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
    for (p, q) in corners().zip(corners().cycle().skip(1)) {
        let (p, q) = (at(p), at(q));
        for (i, component) in normal.iter_mut().enumerate() {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            *component += (p[j] - q[j]) * (p[k] + q[k]);
        }
        (low, high, largest) = (low.min(p[2]), high.max(p[2]), largest.max(p[2].abs()));
    }
    let growth = (normal[0].abs() + normal[1].abs()) / normal[2].abs();
    // A polygon that is seen edge-on divides by 0. Then the range of its depths is the smaller one.
    let snapped = f64::min(growth * SubPixel::DELTA.to_num::<f64>(), high - low);
    let rounded = f64::from(ROUNDINGS * f32::EPSILON / 2.0) * largest;
    (snapped + rounded) as f32
}

/// True if two polygons have the same corners on the screen, whichever corner they begin with and
/// whichever way they run.
fn are_equal(frame: &Frame, polygons: [u32; 2]) -> bool {
    let [a, b] = polygons.map(|index| {
        let mut corners: Vec<&ScreenVertex> = frame
            .corners(&frame.polygons()[index as usize])
            .iter()
            .map(|&v| &frame.vertices()[v as usize])
            .collect();
        corners.sort_by(|p, q| p.compare(q));
        corners
    });
    a == b
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::{DepthRange, FrameBuilder, Vertex};
    use crate::mesh::Material;
    use crate::scene::{DepthBits, DepthBuffer, DepthSource, HiddenSurfaces, Lighting};
    use glam::DVec3;

    /// The corners of a polygon: column, row, depth.
    type Corners<'a> = &'a [[f64; 3]];

    fn ties(polygons: &[Corners], change: impl Fn(&mut FrameBuilder)) -> DepthTies {
        let mut builder = FrameBuilder::new(64, 64);
        change(&mut builder);
        let material = Lighting::new(&Material::default(), [1.0; 3], &[], DVec3::Z);
        let material = builder.lighting(material);
        for (index, corners) in (0..).zip(polygons) {
            let corners: Vec<u32> = corners
                .iter()
                .map(|&[x, y, depth]| {
                    builder.vertex(Vertex {
                        x: SubPixel::from_num(x),
                        y: SubPixel::from_num(y),
                        depth,
                        inv_w: 1.0,
                        normal: [0.0, 0.0, 1.0],
                        material,
                    })
                })
                .collect();
            builder.polygon(&corners, [0.0, 0.0, 1.0], index);
        }
        depth_ties(&builder.finish().expect("corners inside the guard band"))
    }

    /// A plane: 0.1 + 0.008 x + 0.001 y.
    const SLOPE: [[f64; 3]; 4] = [
        [3.3, 2.1, 0.1285],
        [60.7, 5.2, 0.5908],
        [58.4, 61.9, 0.6291],
        [1.9, 55.3, 0.1705],
    ];

    #[test]
    fn one_face_in_other_pieces_is_a_tie() {
        let [a, b, c, d] = SLOPE;
        let pieces: [Corners; 3] = [&SLOPE, &[a, b, c], &[a, c, d]];
        let found = ties(&pieces, |_| ());
        assert!(found.samples > found.covered / 2, "{found:?}");
        assert_eq!((found.polygons, found.doubled), (3, 0));
    }

    #[test]
    fn doubled_faces_are_no_tie_and_are_counted() {
        let [a, b, c, d] = SLOPE;
        let found = ties(&[&SLOPE, &[c, b, a, d], &[b, c, d, a]], |_| ());
        assert_eq!((found.samples, found.doubled), (0, 2));
        assert!(found.covered > 2000);
    }

    #[test]
    fn what_lies_apart_and_what_only_meets_at_an_edge_are_no_ties() {
        let [a, b, c, d] = SLOPE;
        let behind = SLOPE.map(|[x, y, z]| [x, y, z + 0.01]);
        for polygons in [[&SLOPE[..], &behind], [&[a, b, c], &[a, c, d]]] {
            let found = ties(&polygons, |_| ());
            assert_eq!((found.samples, found.doubled), (0, 0));
        }
    }

    #[test]
    fn equal_levels_are_a_tie_and_floats_are_not() {
        let wall = |z| [[2.0, 2.0, z], [60.0, 2.0, z], [60.0, 60.0, z]];
        for (bits, is_tie) in [(DepthBits::Sixteen, true), (DepthBits::ThirtyTwo, false)] {
            let found = ties(&[&wall(0.5), &wall(0.500_004)], |builder| {
                let source = DepthSource::Interpolated;
                builder.hidden_surfaces(HiddenSurfaces::ZBuffer(DepthBuffer { bits, source }));
            });
            assert_eq!(found.samples > 0, is_tie, "{bits:?}");
        }
    }

    #[test]
    fn distance_makes_no_tie_under_perspective() {
        let wall = |w: f64| [[2.0, 2.0], [60.0, 2.0], [60.0, 60.0]].map(|[x, y]| [x, y, -1.0 / w]);
        for w in [1e-2, 1.0, 1e6] {
            let found = ties(&[&wall(w * 1.0001), &wall(w)], |builder| {
                let (near, far) = (1e-3, 1e7);
                builder.depth_range(DepthRange::Perspective { near, far });
            });
            assert_eq!(found.samples, 0, "{w}");
        }
    }
}
