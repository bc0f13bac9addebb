use super::scaling::{Costs, ScalingPoint};
use super::*;
use crate::compare::timing::{TimeLimits, Timing};
use alloc::vec;
use core::time::Duration;

const QUICK: TimeLimits = TimeLimits {
    time_budget: Duration::ZERO,
    rounds: 5,
    warm_up_rounds: 1,
};

fn variants(names: &[&str]) -> Vec<Variant> {
    names
        .iter()
        .map(|name| Variant::parse(name).unwrap())
        .collect()
}

fn small_scaling() -> Scaling {
    let options = ScalingOptions {
        triangles: vec![100, 400, 1600],
        at: [96, 54],
        sizes: vec![[48, 36], [96, 54], [192, 108]],
        of: 400,
        lecture_up_to: 400,
        limits: QUICK,
    };
    let mut told = Vec::new();
    let asked = variants(&["gouraud", "flat", "phong-rsqrt"]);
    let measured = Scaling::measure(&asked, &options, &mut |part, _| told.push(part)).unwrap();
    assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
    measured
}

#[test]
fn every_view_is_drawn_once_by_every_method_that_was_asked_for() {
    let measured = small_scaling();
    let names: Vec<_> = measured
        .curves
        .iter()
        .map(|c| (&*c.method, c.engine, c.level))
        .collect();
    let fastest = Renderer::fastest().level().name();
    assert_eq!(
        names[..3],
        [
            ("gouraud", "row", fastest),
            ("naive-phong", "row", fastest),
            ("phong-rsqrt", "row", fastest)
        ],
        "flat is none of the few"
    );
    assert_eq!(names[3..], [("naive-phong", "span", "scalar")]);
    // Three meshes, two more sizes, and two views from afar.
    assert_eq!(measured.points.len(), 7);
    let near = || measured.points.iter().filter(|p| !p.away);
    let asked = near().filter(|p| p.size == [96, 54]).map(|p| p.asked);
    assert_eq!(asked.collect::<Vec<_>>(), [100, 400, 1600]);
    let sizes = near().filter(|p| p.asked == 400).map(|p| p.size);
    assert_eq!(sizes.collect::<Vec<_>>(), [[96, 54], [48, 36], [192, 108]]);
    for curve in &measured.curves {
        let is_lecture = curve.level == "scalar" && curve.engine == "span";
        let timed: Vec<bool> = curve.times.iter().map(Option::is_some).collect();
        let expected: Vec<bool> = measured
            .points
            .iter()
            .map(|p| !is_lecture || p.asked <= 400)
            .collect();
        assert_eq!(timed, expected, "{curve:?}");
    }
}

#[test]
fn counts_agree_with_a_sphere() {
    let measured = small_scaling();
    for point in &measured.points {
        // Euler: a closed surface of triangles without holes has V − T/2 = 2.
        assert_eq!(point.vertices, point.triangles / 2 + 2, "{point:?}");
        assert!(
            point.drawn < point.triangles && point.drawn > point.triangles / 3,
            "about half are seen"
        );
        let [width, height] = point.size.map(|side| side as usize);
        assert!(point.spans <= point.pixels && point.pixels < width * height);
    }
    let [near, away] = [false, true].map(|away| {
        let is_it = |p: &&ScalingPoint| p.away == away && p.asked == 400 && p.size == [192, 108];
        measured.points.iter().find(is_it).unwrap()
    });
    // The far view covers a sixteenth of the area, up to pixels along the outline. The small
    // picture has a radius of 0.8 · 54/4 = 10.8, so its outline has 68 pixels.
    assert!(
        near.pixels.abs_diff(16 * away.pixels) < 16 * 68,
        "{near:?} {away:?}"
    );
}

#[test]
fn costs_that_made_the_times_are_found_again() {
    let mut measured = small_scaling();
    let costs = Costs {
        vertex_ns: 20.0,
        triangle_ns: 50.0,
        span_ns: 10.0,
        pixel_ns: 3.0,
        background_ns: 0.5,
        worst: 0.0,
        worst_point: 0,
    };
    let timing = |ns: f64| Timing::of(vec![ns, 2.0 * ns], 1).unwrap();
    for point in &mut measured.points {
        point.projection = timing(costs.vertex_ns * point.vertices as f64);
    }
    let times: Vec<_> = measured
        .points
        .iter()
        .map(|point| Some(timing(costs.explain(point))))
        .collect();
    for curve in &mut measured.curves {
        curve.times = times.clone();
    }
    // One frame takes a tenth longer than its costs.
    let mut odd = measured.clone();
    odd.curves[0].times[2] = times[2].as_ref().map(|t| timing(1.1 * t.min_ns));
    measured.explain();
    for curve in &measured.curves {
        let found = curve.costs.unwrap();
        let pairs = [
            (found.vertex_ns, costs.vertex_ns),
            (found.triangle_ns, costs.triangle_ns),
            (found.span_ns, costs.span_ns),
            (found.pixel_ns, costs.pixel_ns),
            (found.background_ns, costs.background_ns),
        ];
        // The tolerance is derived in the tests of the fit.
        assert!(
            pairs
                .iter()
                .all(|(found, cost)| (found / cost - 1.0).abs() < 1e-6),
            "{found:?}"
        );
        assert!(found.worst.abs() < 1e-6);
    }
    odd.explain();
    let found = odd.curves[0].costs.unwrap();
    // The other points pull the line back, so the residual is at most the tenth.
    assert!(
        found.worst.abs() > 0.001 && found.worst.abs() <= 0.1,
        "{found:?}"
    );
    odd.points.truncate(3);
    odd.explain();
    assert!(odd.curves[1].costs.is_none(), "three points for four costs");
}

#[test]
fn there_are_four_corners_and_naive_phong_is_one_of_the_methods() {
    let options = SpeedupOptions {
        triangles: 200,
        size: [64, 48],
        span: 64,
        limits: QUICK,
    };
    let asked = variants(&["gouraud", "fast-phong"]);
    let mut told = Vec::new();
    let measured = Speedups::measure(&asked, &options, &mut |part, _| told.push(part)).unwrap();
    assert!(told.is_sorted() && told.last() == Some(&1.0), "{told:?}");
    let corners: Vec<_> = measured
        .corners
        .iter()
        .map(|c| (c.work, c.scalar, c.lights))
        .collect();
    let frames = corners
        .iter()
        .position(|corner| *corner == (Work::Frame, true, 1))
        .unwrap();
    assert_eq!(corners[frames + 1], (Work::Frame, false, 1));
    assert_eq!(corners[0], (Work::Kernel, true, 1));
    if fastphong::number::SimdLevel::best() != fastphong::number::SimdLevel::Scalar {
        assert_eq!(corners[1], (Work::Kernel, false, 1));
        assert_eq!(
            corners[4..],
            [(Work::Kernel, true, 4), (Work::Kernel, false, 4)]
        );
    }
    let names: Vec<&str> = measured.methods.iter().map(|m| &*m.method).collect();
    assert_eq!(names, ["naive-phong", "gouraud", "fast-phong"]);
    let [naive, gouraud, fast] = &measured.methods[..] else {
        unreachable!("three names")
    };
    assert!(naive.levels_off == 0 && fast.levels_off <= 1 && gouraud.levels_off > 1);
    for method in &measured.methods {
        assert_eq!(method.corners.len(), measured.corners.len());
        assert!(
            method
                .corners
                .iter()
                .all(|speedup| speedup.timing.samples_ns.len() >= 5)
        );
    }
    let itself = naive.corners[0].ratio_to_naive.unwrap();
    assert_eq!((itself.low, itself.median, itself.high), (1.0, 1.0, 1.0));
}

#[test]
fn impossible_requests_are_rejected() {
    let none = SpeedupOptions {
        size: [0, 48],
        limits: QUICK,
        ..SpeedupOptions::default()
    };
    assert!(matches!(
        Speedups::measure(&[], &none, &mut |_, _| ()),
        Err(ExperimentError::Frame(_))
    ));
    let sizes = vec![[16, 12]];
    let many = ScalingOptions {
        triangles: vec![usize::MAX],
        at: [16, 12],
        sizes,
        of: 20,
        lecture_up_to: 0,
        limits: QUICK,
    };
    assert!(Scaling::measure(&[], &many, &mut |_, _| ()).is_err());
}
