use alloc::string::ToString;

use super::flip::Perceived;
use super::*;
use crate::picture::{LinearPicture, Picture, Picture8};

/// Returns a pair of opaque pictures. `noise` of column, row and channel is added to the second,
/// then clamped.
fn pair(width: usize, height: usize, noise: fn(i64, i64, i64) -> i64) -> [Picture8; 2] {
    let mut pair = [
        Picture8::new(width, height, [255; 4]),
        Picture8::new(width, height, [255; 4]),
    ];
    for y in 0..height {
        for x in 0..width {
            for c in 0..3 {
                let (x_, y_, c_) = (x as i64, y as i64, c as i64);
                let value = (x_ * 9 + y_ * 5 + c_ * 40 + (x_ * y_) % 17) % 256;
                pair[0].row_mut(y)[x][c] = value as u8;
                pair[1].row_mut(y)[x][c] = (value + noise(x_, y_, c_)).clamp(0, 255) as u8;
            }
        }
    }
    pair
}

struct Known {
    size: [usize; 2],
    noise: fn(i64, i64, i64) -> i64,
    max_levels: f64,
    rms_levels: f64,
    mae_levels: f64,
    signed_levels: f64,
    psnr: f64,
    ssim: f64,
    flip: f64,
}

/// Known metrics of four pairs, made with scikit-image 0.26.0 and NumPy 2.4.6:
///
/// ```text
/// from skimage.metrics import structural_similarity, peak_signal_noise_ratio
/// y, x, c = np.mgrid[0:h, 0:w, 0:3]
/// r = (x * 9 + y * 5 + c * 40 + (x * y) % 17) % 256
/// a = np.clip(r + noise(x, y, c), 0, 255)
/// lr, la = ((p / 255.0) @ [0.2126, 0.7152, 0.0722] for p in (r, a))
/// ssim = structural_similarity(lr, la, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0)
/// psnr = peak_signal_noise_ratio(r / 255.0, a / 255.0, data_range=1.0)
/// max, rms, mae = abs(a - r).max(), np.sqrt(((a - r) ** 2).mean()), abs(a - r).mean()
/// signed = ((la - lr) * 255).mean()
/// ```
///
/// ꟻLIP is made with flip_evaluator 1.7, the implementation by its authors, in f32:
///
/// ```text
/// map, _, _ = flip_evaluator.evaluate(*(np.float32(p / 255.0) for p in (r, a)), "LDR", applyMagma=False)
/// flip = np.float64(map).mean()
/// ```
#[rustfmt::skip]
static KNOWN: [Known; 4] = [
    Known {
        size: [11, 11], noise: |x, y, c| (x * y + c) % 5 - 2,
        max_levels: 2.0, rms_levels: 1.3696835612108513, mae_levels: 1.1267217630853994,
        signed_levels: -0.38290247933884364, psnr: 45.39839873991237, ssim: 0.9981901887766458,
        flip: 0.02376365901763774,
    },
    Known {
        size: [40, 16], noise: |x, y, c| (3 * x + 7 * y + c) % 5 - 2,
        max_levels: 2.0, rms_levels: 1.407753825543846, mae_levels: 1.1911458333333333,
        signed_levels: 0.003682812499999075, psnr: 45.160269284648685, ssim: 0.9983545024187952,
        flip: 0.011683460400854528,
    },
    Known {
        size: [13, 31], noise: |x, y, c| (x * x + 11 * y + 5 * c) % 97 - 48,
        max_levels: 48.0, rms_levels: 26.34543387109196, mae_levels: 22.31017369727047,
        signed_levels: -0.8982258064516121, psnr: 19.716696505318282, ssim: 0.46569468528196845,
        flip: 0.24193979435537943,
    },
    Known {
        size: [24, 17], noise: |_, _, _| 20,
        max_levels: 20.0, rms_levels: 19.44001583554588, mae_levels: 19.17401960784314,
        signed_levels: 19.14215049019608, psnr: 22.356871321475435, ssim: 0.992065160983734,
        flip: 0.346359987031011,
    },
];

fn near(got: f64, expected: f64, tolerance: f64) {
    assert!(
        (got - expected).abs() <= tolerance,
        "{got} is not {expected} ± {tolerance:e}"
    );
}

#[test]
fn numbers_equal_those_of_scikit_image() {
    for known in &KNOWN {
        let [reference, actual] = pair(known.size[0], known.size[1], known.noise);
        let d = compare(&reference, &actual).unwrap();
        assert_eq!(d.max, known.max_levels / 255.0);
        // Sums of n values up to 255² or 255 in f64 are off by less than n 2^-53 of the sum of
        // their amounts. This is 1e-12 of it for the 1920 values here, below 3e-11 levels for the
        // means.
        near(d.rms * 255.0, known.rms_levels, 3e-11);
        near(d.mae * 255.0, known.mae_levels, 3e-11);
        near(d.signed_mean * 255.0, known.signed_levels, 3e-11);
        assert_eq!(d.frame_rms, d.rms, "all pixels are covered");
        // 20 log10(1 + 1e-12) is 9e-12 dB.
        near(d.psnr, known.psnr, 1e-11);
        // Window means of values in 0..=1 take 22 products and sums in two passes. They are off by
        // 50 * 2^-53 = 6e-15, and variances by four times that, on both sides. The smallest
        // denominator is C2 = 9e-4, so the quotient is off by 6e-11.
        near(d.ssim.unwrap(), known.ssim, 6e-11);
        // Both are in f32, and their pixels are within 1e-4 of each other: see `flip`.
        let map = Perceived::new(&reference).flip(&Perceived::new(&actual));
        near(mean_flip(&map.unwrap()), known.flip, 1e-5);
    }
}

#[test]
fn linear_and_stored_pictures_have_the_same_numbers() {
    let [reference, actual] = pair(40, 16, |x, y, c| (3 * x + 7 * y + c) % 5 - 2);
    let linear = |picture: &Picture8| picture.map(|t| t.map(|c| f32::from(c) / 255.0));
    let stored = compare(&reference, &actual).unwrap();
    let d = compare(&linear(&reference), &linear(&actual)).unwrap();
    // The nearest f32 to k/255 is off by at most 2^-25, a difference of two by twice that.
    let rounding = 2.0 / f64::from(1 << 25);
    near(d.max, stored.max, rounding);
    near(d.rms, stored.rms, rounding);
    near(d.signed_mean, stored.signed_mean, rounding);
    assert_eq!(d.differing, stored.differing);
    let mixed = compare(&reference, &linear(&reference)).unwrap();
    assert!(
        mixed.max <= rounding,
        "a stored picture against the linear one it was rounded from"
    );
}

#[test]
fn equal_pictures_have_no_difference() {
    let [picture, _] = pair(20, 20, |_, _, _| 0);
    let d = compare(&picture, &picture).unwrap();
    assert!(d.equal);
    assert_eq!(
        (d.max, d.worst, d.rms, d.p99, d.signed_mean),
        (0.0, None, 0.0, 0.0, 0.0)
    );
    assert_eq!(d.psnr, f64::INFINITY);
    assert_eq!(d.ssim, Some(1.0));
    assert_eq!(
        (d.frame, d.compared, d.differing, d.over_half_level),
        (400, 400, 0, 0)
    );
}

#[test]
fn nothing_at_all_is_equal_to_itself() {
    let nothing = Picture8::new(0, 0, [0; 4]);
    let d = compare(&nothing, &nothing).unwrap();
    assert_eq!(
        (d.frame, d.compared, d.rms, d.p99, d.psnr, d.ssim),
        (0, 0, 0.0, 0.0, f64::INFINITY, None)
    );
    assert_eq!((d.share(0), d.mae, d.signed_mean), (0.0, 0.0, 0.0));
}

#[test]
fn pictures_without_a_compared_pixel_are_equal_only_if_all_samples_are() {
    let reference = Picture8::new(4, 3, [9, 9, 9, 0]);
    assert!(compare(&reference, &reference).unwrap().equal);
    let mut actual = reference.clone();
    actual.row_mut(2)[3] = [9, 9, 10, 0];
    let d = compare(&reference, &actual).unwrap();
    assert_eq!((d.compared, d.differing, d.equal), (0, 0, false));
    // The only pixel that is covered is left out.
    actual.row_mut(2)[3] = [1, 9, 9, 255];
    let d = compare_where(&reference, &actual, |x, _| x < 3).unwrap();
    assert_eq!((d.compared, d.equal), (0, false));
    assert!(compare_where(&actual, &actual, |x, _| x < 3).unwrap().equal);
    let nan = LinearPicture::new(2, 2, [f32::NAN, 0.0, 0.0, 0.0]);
    assert!(compare(&nan, &nan.clone()).unwrap().equal);
}

#[test]
fn background_does_not_dilute() {
    let mut reference = Picture8::new(10, 10, [9, 9, 9, 0]);
    reference.row_mut(4)[2] = [100, 100, 100, 255];
    let mut actual = reference.clone();
    actual.row_mut(4)[2] = [110, 110, 110, 255];
    let d = compare(&reference, &actual).unwrap();
    assert_eq!((d.frame, d.compared), (100, 1));
    assert_eq!(d.rms, 10.0 / 255.0);
    // A hundredth of the pixels carries all squares: a tenth of the root, with three roundings.
    near(d.frame_rms, 1.0 / 255.0, 3.0 * f64::EPSILON);
    assert_eq!(d.share(d.over_one_level), 1.0);

    actual.row_mut(0)[0] = [9, 9, 13, 0];
    let d = compare(&reference, &actual).unwrap();
    assert_eq!(
        (d.compared, d.differing),
        (1, 1),
        "colours under alpha 0 do not count"
    );
}

#[test]
fn coverage_is_counted_on_its_own() {
    let reference = Picture8::new(4, 1, [9, 9, 9, 0]);
    let mut actual = reference.clone();
    actual.row_mut(0)[1] = [9, 9, 9, 255];
    let d = compare(&reference, &actual).unwrap();
    assert_eq!(
        (d.coverage_mismatches, d.compared, d.differing, d.max),
        (1, 1, 1, 1.0)
    );
    assert_eq!((d.not_finite, d.not_finite_differing), (0, 0));
    assert!(!d.equal);
    // The object that one picture lacks is not hidden by the colour that the other stores there.
    assert_eq!((d.rms, d.mae, d.signed_mean), (1.0, 1.0, 0.0));
    // A faint pixel against none is alpha's difference: there is no colour to compare.
    actual.row_mut(0)[1] = [255, 255, 255, 3];
    let d = compare(&reference, &actual).unwrap();
    assert_eq!((d.coverage_mismatches, 255.0 * d.max), (1, 3.0));
}

#[test]
fn alpha_is_one_channel_of_a_pixel() {
    let reference = Picture8::new(2, 1, [9, 9, 9, 127]);
    let d = compare(&reference, &Picture8::new(2, 1, [9, 9, 9, 128])).unwrap();
    assert_eq!(
        (d.coverage_mismatches, d.differing, d.max),
        (0, 2, 1.0 / 255.0)
    );
    assert!(!d.equal && d.psnr.is_finite());
    let d = compare(&reference, &Picture8::new(2, 1, [14, 9, 9, 128])).unwrap();
    assert_eq!(
        (255.0 * d.max, 255.0 * 3.0 * d.mae),
        (5.0, 7.0),
        "5, and twice at least 1"
    );
}

#[test]
fn thresholds_bite_beyond_whole_and_half_levels() {
    let reference = Picture8::new(3, 1, [200, 200, 200, 255]);
    let actual = Picture8::from_pixels(
        3,
        1,
        [[200, 201, 200, 255], [202, 200, 200, 255], [200; 4]].to_vec(),
    )
    .unwrap();
    let d = compare(&reference, &actual).unwrap();
    assert_eq!(
        (d.over_half_level, d.over_one_level),
        (3, 2),
        "one level is not more than one level, and alpha is off by 55"
    );
    assert_eq!(
        (d.coverage_mismatches, d.differing),
        (0, 3),
        "alpha 200 differs and covers"
    );

    let linear = |c: f32| LinearPicture::new(1, 1, [c, 0.0, 0.0, 1.0]);
    let levels = |c: f64| Picture::new(1, 1, Levels([c, 0.0, 0.0, 255.0]));
    assert_eq!(
        compare(&levels(0.0), &levels(0.5)).unwrap().over_half_level,
        0,
        "half a level is not more than half"
    );

    // Test both sides of 0.5/255 = 0.0019607….
    assert_eq!(
        compare(&linear(0.0), &linear(0.001_960))
            .unwrap()
            .over_half_level,
        0
    );
    assert_eq!(
        compare(&linear(0.0), &linear(0.001_961))
            .unwrap()
            .over_half_level,
        1
    );
}

#[test]
fn worst_is_the_first_of_the_largest() {
    let reference = Picture8::new(5, 3, [50, 50, 50, 255]);
    let mut actual = reference.clone();
    for (x, y, blue) in [(4, 0, 53), (1, 1, 40), (3, 2, 60)] {
        actual.row_mut(y)[x][2] = blue;
    }
    assert_eq!(compare(&reference, &actual).unwrap().worst, Some([1, 1]));
}

#[test]
fn values_not_finite_are_full_errors_and_keep_means_finite() {
    let reference = LinearPicture::new(12, 12, [0.5, 0.5, 0.5, 1.0]);
    for wrong in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let mut actual = reference.clone();
        actual.row_mut(3)[4][1] = wrong;
        for d in [
            compare(&reference, &actual).unwrap(),
            compare(&actual, &reference).unwrap(),
        ] {
            assert_eq!(
                (d.not_finite, d.max, d.worst, d.over_one_level),
                (1, 1.0, Some([4, 3]), 1)
            );
            assert_eq!((d.not_finite_differing, d.equal), (1, false));
            assert!(d.rms.is_finite() && d.signed_mean.is_finite() && d.ssim.unwrap() < 1.0);
        }
        let same = compare(&actual, &actual).unwrap();
        assert_eq!((same.not_finite, same.not_finite_differing), (1, 0));
        assert_eq!((same.equal, same.max, same.p99), (true, 0.0, 0.0));
    }
    let of = |c| LinearPicture::new(1, 1, [c, 0.0, 0.0, 1.0]);
    let d = compare(&of(f32::INFINITY), &of(f32::NEG_INFINITY)).unwrap();
    assert_eq!((d.not_finite_differing, d.max), (1, 1.0));
    // Two kinds of NaN are one, and so are both zeros. Values beyond the range count as they are.
    assert!(compare(&of(f32::NAN), &of(-f32::NAN)).unwrap().equal);
    assert!(compare(&of(0.0), &of(-0.0)).unwrap().equal);
    assert_eq!(compare(&of(-2.0), &of(3.0)).unwrap().max, 5.0);
}

#[test]
fn excluded_pixels_enter_nothing() {
    let [reference, mut actual] = pair(20, 15, |_, _, _| 0);
    actual.row_mut(3)[4] = [255, 255, 255, 0];
    actual.row_mut(9)[9][0] ^= 1;
    let d = compare_where(&reference, &actual, |x, y| (x, y) != (4, 3)).unwrap();
    assert_eq!((d.frame, d.excluded, d.compared), (299, 1, 299));
    assert_eq!(
        (d.differing, d.coverage_mismatches, d.max, d.worst),
        (1, 0, 1.0 / 255.0, Some([9, 9]))
    );
    let mut repaired = actual.clone();
    repaired.row_mut(3)[4] = reference.get(4, 3);
    assert_eq!(d.ssim, compare(&reference, &repaired).unwrap().ssim);
    assert_ne!(d.ssim, compare(&reference, &actual).unwrap().ssim);
}

#[test]
fn sizes_must_agree() {
    let mismatch = compare(
        &Picture8::new(4, 3, [0; 4]),
        &LinearPicture::new(3, 4, [0.0; 4]),
    )
    .unwrap_err();
    assert_eq!(
        mismatch,
        SizeMismatch {
            reference: [4, 3],
            actual: [3, 4]
        }
    );
    assert_eq!(
        mismatch.to_string(),
        "the reference is 4×3 pixels, the other picture 3×4: expected the same size"
    );
}

#[test]
fn every_metric_states_its_value_and_names_are_unique() {
    let [reference, actual] = pair(40, 16, |x, y, c| (3 * x + 7 * y + c) % 5 - 2);
    let mut d = compare(&reference, &actual).unwrap();
    assert_eq!(d.flip, None, "it was not asked for");
    d.flip = Some(0.25);
    for metric in METRICS {
        assert!(
            std::ptr::eq(MetricInfo::named(metric.name).unwrap(), metric),
            "{} is there twice",
            metric.name
        );
        assert!((metric.value)(&d).is_some(), "{}", metric.name);
    }
    let value = |name| (MetricInfo::named(name).unwrap().value)(&d).unwrap();
    // 255 (2 / 255): two roundings of numbers near 2.
    near(value("max"), 2.0, 2.0 * f64::EPSILON);
    assert_eq!(value("over-one"), 100.0 * d.over_one_level as f64 / 640.0);
    assert_eq!(value("differing"), d.differing as f64);
    assert!(MetricInfo::named("loudness").is_none());
}

#[cfg(feature = "io")]
#[test]
fn differences_survive_json() {
    let [reference, actual] = pair(12, 12, |x, _, _| x);
    for picture in [&reference, &actual] {
        let d = compare(&reference, picture).unwrap();
        let json = serde_json::to_string(&d).unwrap();
        assert_eq!(json.contains("\"psnr\":null"), d.psnr.is_infinite());
        let back: serde_json::Value = serde_json::from_str(&json).unwrap();
        let psnr = back["psnr"].as_f64().unwrap_or(f64::INFINITY);
        // A decimal number may be parsed as a neighbouring float: one unit in the last place of
        // 16..32.
        assert!(psnr == d.psnr || (psnr - d.psnr).abs() <= 16.0 * f64::EPSILON);
        assert_eq!(back["worst"], serde_json::json!(d.worst));
        assert_eq!(back["compared"], d.compared);
        assert!(back["ssim"].is_f64());
    }
}

/// A picture of one row, of one column, and of one pixel has every metric except SSIM, whose window
/// does not fit.
#[test]
fn thin_pictures_are_compared() {
    for [width, height] in [[1, 1], [1, 400], [400, 1]] {
        let reference = Picture8::new(width, height, [100, 100, 100, 255]);
        let mut actual = reference.clone();
        actual.row_mut(height - 1)[width - 1] = [110, 100, 100, 255];
        let d = compare(&reference, &actual).unwrap();
        assert_eq!((255.0 * d.max, d.differing, d.ssim), (10.0, 1, None));
        assert_eq!(d.worst, Some([width - 1, height - 1]));
        assert!(mean_flip(&flip_map(&reference, &actual).unwrap()) > 0.0);
    }
}

/// Rows that are filtered some at a time give the same map as all at once, to the last bit.
#[test]
fn flip_by_parts_is_flip() {
    // Narrower than a part, and in several parts of 1,048,576 pixels.
    for [width, height] in [[40, 33], [8192, 140]] {
        let noise = |x: i64, y: i64, c: i64| (x * x / 7 + 3 * y + c) % 9 - 4;
        let [reference, actual] = pair(width, height, noise);
        let whole = Perceived::new(&reference).flip(&Perceived::new(&actual));
        assert!(
            whole.unwrap() == flip_map(&reference, &actual).unwrap(),
            "{width}×{height}"
        );
    }
}
