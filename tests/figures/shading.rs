//! Figures of interpolation: exercises, squares, Mach bands, Newton's root, great circles.

use super::{agreement, made, value};
use fastphong::raster::trace::Trace;
use fastphong_cli::lectures::{Agreement, FigureBlock};

#[test]
fn exercises_have_the_results_of_theory() {
    let content = made("exercises");
    // 0.40674 + 0.3 (0.42262 − 0.40674) = 0.411504. The engine adds three steps of an f32, each off
    // by at most 2⁻²⁵, to a start whose normal is off by the same amount: below 2⁻²².
    let f32_error = 1.0 / f64::from(1 << 22);
    assert!((value(&content, "sine") - 0.411504).abs() < f32_error);
    // The chord of one degree lies below the sine by at most sin 25° (1°)²/8 = 1.6e-5. The table is
    // off by 5e-6.
    let error = value(&content, "sine-error");
    assert!(error > 0.0 && error < 1.6e-5 + 5e-6, "{error}");
    assert_eq!(value(&content, "multiplications"), 1.0);
    // Each pixel adds two roundings of 2⁻²⁴ over 1023 steps. They add up: a walk in f32 drifts.
    let drift = value(&content, "drift");
    assert!(
        drift > 1e-7 && drift < 2.0 * 1023.0 / f64::from(1 << 24),
        "{drift}"
    );
    // These roundings add up over at most 230 pixels. Depth is off by as many, times the density
    // 2.5.
    let levels = value(&content, "fog");
    assert!(
        levels < 255.0 * (2.0 + 2.5) * 230.0 / f64::from(1 << 24),
        "{levels}"
    );
    for key in ["sine", "multiplications", "drift", "fog"] {
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}");
    }
}

#[test]
fn gouraud_keeps_the_predicted_share_of_a_highlight() {
    let content = made("highlight");
    // The corners of a cell 2a wide, whose middle faces the eye, lean by θ with cos θ = cos² a.
    // There light from the eye is reflected at 2θ. In the middle Gouraud has the mean of the four:
    // k_s cosⁿ 2θ + k_d (cos θ − 1) of naive Phong's k_s.
    for (key, cells, n) in [
        ("coarse", 16.0, 64.0),
        ("fine", 96.0, 64.0),
        ("dull", 48.0, 4.0),
    ] {
        let cosine = (std::f64::consts::PI / cells).cos().powi(2);
        let twice = 2.0 * cosine * cosine - 1.0;
        let kept = (twice.powf(n) + 0.3 / 0.6 * (cosine - 1.0)).max(0.0);
        // The pixel's centre lies half a pixel of 76 from the middle: 2 · 0.53° off, and cos⁶⁴ of
        // that is 0.989.
        let found = value(&content, key);
        assert!((found - 100.0 * kept).abs() < 1.5, "{key}: {found} {kept}");
    }
    assert_eq!(agreement(&content, "coarse"), Agreement::Confirms);
    assert_eq!(agreement(&content, "dull"), Agreement::Adds);
}

/// The traces of the figure that stops show what its text says: colours, an edge through pixel
/// centres, and two normals that nearly oppose each other.
#[test]
fn findings_of_the_stopped_mesh_follow_from_its_traces() {
    let content = made("stop");
    let trace = |name: &str| -> &Trace {
        let mut traces = content.blocks.iter().filter_map(|block| match block {
            FigureBlock::Trace { method, trace } if method == name => Some(&**trace),
            _ => None,
        });
        traces
            .next_back()
            .unwrap_or_else(|| panic!("a trace of {name}"))
    };
    let pixels = |name: &str| {
        let runs = trace(name).lines.iter().flat_map(|line| &line.runs);
        let colours: Vec<f32> = runs.flat_map(|run| &run.colours).map(|c| c[0]).collect();
        assert!(colours.len() > 150, "{name}: {} pixels", colours.len());
        colours
    };
    let naive = pixels("naive-phong");
    for (key, name, range) in [
        ("gouraud", "gouraud", 20.0..255.0),
        ("one", "fast-phong:steps=1", 0.5..20.0),
        ("two", "fast-phong:steps=2", 0.0..0.5),
    ] {
        let apart = pixels(name).into_iter().zip(&naive);
        let most = apart.fold(0.0f64, |most, (a, b)| most.max(f64::from(a - b).abs()));
        let found = value(&content, key);
        // Subtracting the colours rounds once more.
        assert!(
            (found - 255.0 * most).abs() < 1e-4,
            "{key}: {found}, {}",
            255.0 * most
        );
        assert!(range.contains(&found), "{key}: {found}");
    }
    assert_eq!(agreement(&content, "gouraud"), Agreement::Confirms);
    assert_eq!(agreement(&content, "one"), Agreement::Contradicts);
    assert_eq!(agreement(&content, "two"), Agreement::Confirms);
    let active = trace("gouraud").lines.iter().flat_map(|line| &line.active);
    let ties = active.filter(|edge| edge.rest[0] == 0).count();
    assert!(ties > 10, "{ties} crossings in pixel centres");
    // The lecture's method takes one true root per run and none at later pixels. The rule takes
    // true roots on some runs.
    let runs = |name: &str| {
        let runs = trace(name).lines.iter().flat_map(|line| &line.runs);
        let rooted = runs.clone().filter(|run| !run.inside.contains_key("guess"));
        (runs.count(), rooted.count())
    };
    assert_eq!(runs("fast-phong:steps=1").1, 0);
    let (all, rooted) = runs("fast-phong");
    assert!(rooted > 0 && rooted < all / 4, "{rooted} of {all}");
}

#[test]
fn gouraud_loses_highlights_inside_triangles_and_not_at_corners() {
    let content = made("spheres");
    // Half of the light at the highlight is specular, 127.5 levels. Inside a triangle with sides of
    // 22° the corners are at least 10° away. There R turns by 20°, and cos²⁸ 20° = 0.18 of the
    // highlight is left.
    let inside = value(&content, "inside");
    assert!((0.7 * 127.5..130.0).contains(&inside), "{inside}");
    // The corner is at most √½ pixels away from a pixel centre. Gouraud loses at most the whole
    // highlight over the 40 pixels to the next corner.
    let corner = value(&content, "corner");
    assert!(corner.abs() < 130.0 * 0.71 / 40.0 + 0.5, "{corner}");
    for key in ["inside-fast", "corner-fast", "fast"] {
        assert!(value(&content, key) < 0.05, "{key}");
    }
    assert_eq!(agreement(&content, "inside"), Agreement::Confirms);
    assert_eq!(agreement(&content, "mean"), Agreement::Confirms);
}

#[test]
fn turning_changes_the_shading_of_squares_and_not_of_triangles() {
    let content = made("square");
    for method in ["gouraud", "naive-phong", "fast-phong", "slerp-phong"] {
        // The middle of the square lies on the diagonal between two white corners at 0°, and
        // between a white and the black one at 90°. Half-way Gouraud's intensity is ½, and the
        // intensity of a normal at 45° is √½: the picture changes by half of white, or by 0.29 of
        // it. Both triangulations differ there equally. Pixels beside the diagonal are half a pixel
        // away, which is less than 3 %.
        let least = 255.0
            * (if method == "gouraud" {
                0.5
            } else {
                1.0 - 0.5f64.sqrt()
            } - 0.03);
        for key in [format!("square-{method}"), format!("diagonals-{method}")] {
            assert!(
                (least..160.0).contains(&value(&content, &key)),
                "{key}: {}",
                value(&content, &key)
            );
        }
        let triangles = value(&content, &format!("triangles-{method}"));
        match method {
            // T24: great circles are not barycentric.
            "slerp-phong" => assert!(triangles > 1.0, "{triangles}"),
            // Both orientations round an affine function over 120 rows and 120 pixels, so N, J and
            // K are each off by 240 · 2⁻²⁴. A normal is at least as long as its z, 0.4 here, so
            // each of these makes the intensity off by √3 / 0.4 times that. Fast Phong adds e²/2 of
            // the second Newton step after a change of d by at most 2 %: 2e-8.
            _ => assert!(
                triangles < 255.0 * 2.0 * 4.4 * 240.0 / f64::from(1 << 24),
                "{method}: {triangles}"
            ),
        }
        let expected = if method == "slerp-phong" {
            Agreement::Contradicts
        } else {
            Agreement::Confirms
        };
        assert_eq!(
            agreement(&content, &format!("triangles-{method}")),
            expected
        );
    }
    assert!(value(&content, "normals-square") > 10.0);
    // As for intensities: 2 · 4.4 · 240 · 2⁻²⁴ = 1.26e-4 of a radian.
    assert!(value(&content, "normals-triangles") < 1.26e-4f64.to_degrees());
}

#[test]
fn interpolated_slopes_jump_at_edges_and_values_do_not() {
    let content = made("mach-bands");
    let control = value(&content, "slope-cylinder");
    for method in ["gouraud", "naive-phong", "slerp-phong"] {
        // Common edges have common normals, so intensities agree. Parabolas through pixels
        // contribute less than the third derivative, at most n³/R³ of 255 levels for the highlight,
        // over 5³ pixels: 0.15.
        let jump = value(&content, &format!("value-{method}"));
        assert!(jump < 0.15, "{method}: {jump}");
        assert_eq!(
            agreement(&content, &format!("value-{method}")),
            Agreement::Confirms
        );
        // T4: the slope jumps by far more than the measurement finds on the smooth cylinder.
        let slope = value(&content, &format!("slope-{method}"));
        assert!(slope > 4.0 * control, "{method}: {slope} against {control}");
        assert_eq!(
            agreement(&content, &format!("slope-{method}")),
            Agreement::Contradicts
        );
    }
    assert!(
        value(&content, "value-flat") > 10.0,
        "L21 2: discontinuities along edges"
    );
    // Gouraud's chords of intensities cut off the highlight. Interpolated normals keep its shape,
    // so their slope jumps less.
    assert!(value(&content, "slope-gouraud") > value(&content, "slope-naive-phong"));
}

#[test]
fn bends_at_an_edge_equal_the_closed_forms() {
    let content = made("duff");
    let [gouraud, naive, slerp] =
        ["gouraud", "naive-phong", "slerp-phong"].map(|key| value(&content, key));
    // φ₁ = 90°, φ₂ = 20°, θ = 40°, two pixels per degree: 255 sin 40° (sin 20°/40 − 1/180) = 0.491.
    // Parabolas through five pixels are off by their third derivative, 1e-4 of that over a facet of
    // 40 pixels. The test allows 2 %.
    let expected =
        255.0 * 40f64.to_radians().sin() * (20f64.to_radians().sin() / 40.0 - 1.0 / 180.0);
    assert!((value(&content, "closed-form") - expected).abs() < 1e-9);
    assert!(
        (naive - expected).abs() < 0.02 * expected,
        "{naive} instead of {expected}"
    );
    // Gouraud: 255 ((cos 20° − cos 40°)/40 − cos 40°/180), because the far left corner is dark.
    // Both sides are lines, where parabolas are exact. 64 + 240 roundings of 2⁻²⁴ · 255 levels over
    // four pixels are below 0.002.
    let chords = 255.0
        * ((20f64.to_radians().cos() - 40f64.to_radians().cos()) / 40.0
            - 40f64.to_radians().cos() / 180.0);
    assert!(
        (gouraud - chords).abs() < 0.002,
        "{gouraud} instead of {chords}"
    );
    assert!(naive > 10.0 * gouraud.abs(), "Duff's surprise");
    // The circle itself does not bend. Only these roundings and a cosine's third derivative at two
    // pixels per degree remain.
    assert!(slerp.abs() < 0.003, "{slerp}");
    assert_eq!(agreement(&content, "naive-phong"), Agreement::Contradicts);
}

#[test]
fn errors_of_newtons_roots_are_within_theory() {
    let content = made("newton");
    // The root is rounded once. N · N has four roundings, which the root halves: 3 · 2⁻²⁴.
    assert!(value(&content, "first-pixel") < 3.0 / f64::from(1 << 24));
    // Over 60° d changes by less than 1.9 % per pixel: its relative rate is tan 30° · 2 sin
    // 30° / 16 at the ends. The previous pixel's error adds to this: e²/2 < 2.4e-4, then
    // e²/2 < 3e-8 and rounding, 5 · 2⁻²⁴.
    let [one, two, three] = [1, 2, 3].map(|steps| value(&content, &format!("error-{steps}")));
    let rounding = 5.0 / f64::from(1 << 24);
    assert!(one > 1e-4 && one < 0.036f64.powi(2) / 2.0, "{one}");
    assert!(two < 2.4e-7 + rounding && three < rounding, "{two} {three}");
    // The rest is the rounding of x and of N over 16 pixels.
    assert!(value(&content, "theory") < 16.0 / f64::from(1 << 24));
    // T26: more steps are better everywhere, but one to three never suffice where normals nearly
    // cancel.
    assert!(value(&content, "limit-1") < value(&content, "limit-2"));
    assert!(value(&content, "limit-2") <= value(&content, "limit-3"));
    let [one, two, three] = [1, 2, 3].map(|steps| value(&content, &format!("opposed-{steps}")));
    assert!(
        one > two && two > three && one > 10.0,
        "{one} {two} {three}"
    );
    assert_eq!(value(&content, "not-finite"), 0.0);
}

#[test]
fn slerp_turns_at_a_constant_speed_within_rounding() {
    let content = made("slerp");
    // A pixel turns by 1.9°. Each normal is off by at most about 130 roundings of 2⁻²⁴: 8e-6 of
    // 0.033.
    assert!(value(&content, "speed-slerp") < 1.0 + 2.0 * 130.0 / f64::from(1 << 24) / 0.0327);
    // 1/cos² 60° = 4 is the ratio between ends and middle. Half a pixel of 64 from the ends it is
    // slightly less.
    let ratio = value(&content, "speed-linear");
    assert!((3.8..4.0).contains(&ratio), "{ratio}");
    assert_eq!(value(&content, "step"), 12.0);
    assert_eq!(agreement(&content, "step"), Agreement::Confirms);
    // Goldman's rotation: the amplitude drifts by 2⁻²³ per step. There are two rotations, over sin
    // 30°.
    let goldman = value(&content, "drift-goldman");
    assert!(goldman < 4.0 * 1024.0 / f64::from(1 << 23), "{goldman}");
    // Chebyshev's recurrence turns a rounding ε of 2 cos δ into an angle ε / (2 δ) at each step.
    // With ε up to 2⁻²⁴ and δ = 30°/1024 that is 6e-5 per pixel and up to 6e-2 at the end. The
    // difference form keeps α to a relative 2⁻²⁴.
    let [chebyshev, difference] =
        ["drift-chebyshev", "drift-difference"].map(|key| value(&content, key));
    assert!(chebyshev > 20.0 * goldman && chebyshev < 0.2, "{chebyshev}");
    assert!(difference < goldman, "{difference} {goldman}");
    // T25: in f32 the cosine of 0.02° is 1 or its neighbour, 1 − 2⁻²⁴. The angle is 0 or at least
    // 0.0198° · k.
    assert!(value(&content, "printed-angle") > 0.01);
    // The method is within its rounding of the reference: 2⁻²² per step of 64 in the cosines, times
    // n = 20 and 2.
    let ends = value(&content, "ends");
    assert!(ends < 255.0 * 64.0 * 40.0 / f64::from(1 << 22), "{ends}");
}

#[test]
fn fast_phong_is_within_a_level_of_naive_phong() {
    let content = made("fast-vs-naive");
    assert!(
        value(&content, "default") <= 1.0,
        "the default steps are chosen so that no pixel differs by a level"
    );
    assert!(value(&content, "one-step") > value(&content, "default"));
    assert!(value(&content, "one-step") >= value(&content, "one-step-sphere"));
    // L21 4.1 and 4.2: one root per pixel, and none. (4.2), (3.6): three additions for a normal,
    // one per channel.
    assert_eq!(
        (
            value(&content, "roots-naive"),
            value(&content, "roots-fast")
        ),
        (1.0, 0.0)
    );
    assert_eq!(
        (
            value(&content, "walk-naive"),
            value(&content, "walk-gouraud")
        ),
        (3.0, 3.0)
    );
    // L21 4.4: four additions and eight multiplications, plus one and two for each of J and K.
    assert_eq!(value(&content, "walk-slerp"), 18.0);
    assert_eq!(agreement(&content, "walk-slerp"), Agreement::Confirms);
}

#[test]
fn errors_fall_with_lighting_frequency_and_mesh_size() {
    let content = made("frequency");
    for end in ["coarsest", "finest"] {
        let [face, vertex, pixel] =
            ["face", "vertex", "pixel"].map(|f| value(&content, &format!("{f}-{end}")));
        assert!(
            face > vertex && vertex > pixel,
            "{end}: {face} {vertex} {pixel}"
        );
    }
    for frequency in ["face", "vertex", "pixel"] {
        let [coarse, fine] =
            ["coarsest", "finest"].map(|end| value(&content, &format!("{frequency}-{end}")));
        // There are sixteen times as many bands, and the error of one colour per face grows at
        // least in proportion to the face's size.
        assert!(coarse > 8.0 * fine, "{frequency}: {coarse} {fine}");
    }
}
