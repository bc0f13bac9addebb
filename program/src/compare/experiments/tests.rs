use super::scaling::ScalingPoint;
use super::*;
use crate::compare::timing::TimeLimits;
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
    // Three meshes, and two more sizes.
    let points = &measured.points;
    assert_eq!(points.len(), 5);
    let is_at = |p: &&ScalingPoint| p.size == [96, 54];
    let asked: Vec<_> = points.iter().filter(is_at).map(|p| p.asked).collect();
    assert_eq!(asked, [100, 400, 1600]);
    let sizes = points.iter().filter(|p| p.asked == 400).map(|p| p.size);
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
        assert!(point.pixels < width * height);
    }
    // Twice as many pixels to a side cover four times the area, up to pixels along the outline. The
    // small picture has a radius of 0.8 · 54/2 = 21.6, so its outline has 136 pixels.
    let [small, large] = [[96, 54], [192, 108]].map(|size| {
        let is_it = |p: &&ScalingPoint| p.asked == 400 && p.size == size;
        measured.points.iter().find(is_it).unwrap().pixels
    });
    assert!(large.abs_diff(4 * small) < 4 * 136, "{small} {large}");
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
                .all(|speedup| speedup.timing.samples_ns.len() >= 3)
        );
    }
    let itself = naive.corners[0].ratio_to_naive.unwrap();
    assert_eq!((itself.low, itself.typical, itself.high), (1.0, 1.0, 1.0));
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
