//! Figures of barycentric coordinates, perspective and CS171's sphere.

use super::{agreement, made, value};
use fastphong_cli::lectures::Agreement;

#[test]
fn printed_barycentric_formulas_are_wrong_by_as_much_as_predicted() {
    let content = made("barycentric");
    // f_ac(b) = −f_ab(c), so the printed γ is −γ/β and negative inside. Of 58 · 59 / 2 pixels only
    // the 58 on ab remain.
    assert!((value(&content, "printed-gamma") - 100.0 * (1.0 - 58.0 / 1711.0)).abs() < 1e-9);
    // −γ/β ≤ 1 with β ≤ 1 and α ≤ 1 is the triangle of a, b and b − c + a with closed edges. The
    // picture holds all of it.
    assert!((value(&content, "printed-gamma-outside") - 100.0).abs() < 5.0);
    assert_eq!(value(&content, "unsigned-areas"), 100.0);
    for key in ["printed-gamma", "printed-gamma-outside", "unsigned-areas"] {
        assert_eq!(agreement(&content, key), Agreement::Contradicts, "{key}");
    }
    for key in ["area", "distance", "centre"] {
        assert_eq!(agreement(&content, key), Agreement::Confirms, "{key}");
    }
}

#[test]
fn interpolation_is_wrong_on_the_screen_and_right_in_space() {
    let content = made("perspective");
    for key in ["wrong-screen", "wrong-screen-triangles"] {
        // Half-way between the near rim, 2.5 away, and the far one, 10.5 away, β is 10.5 / 13 =
        // 0.81 and the screen has ½: an error of 2.5 of eight squares. From 0 at a rim to that
        // point the error passes from ½ to 1½ squares, where most pixels are wrong. This is at
        // least a quarter of the way: more than an eighth of all pixels.
        assert!(
            value(&content, key) > 12.5,
            "{key}: {}",
            value(&content, key)
        );
        assert_eq!(
            agreement(&content, key),
            Agreement::Confirms,
            "{key}: the slide asks what is wrong"
        );
    }
    // Corners are snapped to 1/512 pixel and a square is some pixels long, so fewer than 1 in 100
    // pixels are that near to a line.
    assert!(value(&content, "wrong-space") < 0.5);
    assert_eq!(agreement(&content, "wrong-space"), Agreement::Confirms);
    // T2: half a pixel from A the weight should be nearly 1: 1 − β − β.
    assert!(value(&content, "printed-weight") > 0.9);
    assert_eq!(
        agreement(&content, "printed-weight"),
        Agreement::Contradicts
    );
    // Value and weight each take 128 additions of an f32 below 1, over a weight of at least ¼: 2 ·
    // 4 · 128 · 2⁻²⁵.
    assert!(value(&content, "weight") < 1024.0 / f64::from(1 << 25));
    // T6: (f + n)/(f − n) − 4fn/((f − n)(f + n)) with n = 1, f = 40: (41² − 160)/(39 · 41).
    assert!((value(&content, "depth") - 1521.0 / 1599.0).abs() < 1e-12);
    assert_eq!(agreement(&content, "depth"), Agreement::Contradicts);
}

#[test]
fn the_sphere_loses_highlights_and_the_cube_test_loses_pixels() {
    let content = made("cs171");
    let [phong, gouraud, printed] =
        ["phong", "gouraud", "printed"].map(|key| value(&content, &format!("peak-{key}")));
    // Cells are 22.5° by 25.7°, and cos 8° to the power of 60 is ½, so the highlight is smaller
    // than a cell. Within 2° of a vertex or edge cos 2° to the power of 60 is 0.96. Unless the
    // middle of the highlight is there, more than 4 % of its 115 levels (½ · 0.9) are lost between
    // vertices: 4.6.
    assert!(
        gouraud < phong - 4.6 && printed < phong - 4.6,
        "{phong}, {gouraud}, {printed}"
    );
    // The largest loss of a pixel is at least that of the brightest one.
    assert!(value(&content, "lost") >= phong - printed);
    assert_eq!(agreement(&content, "peak-gouraud"), Agreement::Confirms);
    assert_eq!(agreement(&content, "lost"), Agreement::Contradicts);
    // In front of the eye the per-pixel test equals clipping, except for the row on the near plane,
    // which is 96 pixels wide.
    assert!(value(&content, "cube-in-front") <= 96.0);
    assert_eq!(agreement(&content, "cube-in-front"), Agreement::Confirms);
    // T29: behind the eye it loses most of the floor.
    assert!(value(&content, "cube-missing") > 500.0);
    assert!(value(&content, "cube-extra") > 0.0);
    for key in ["cube-missing", "cube-extra"] {
        assert_eq!(agreement(&content, key), Agreement::Contradicts, "{key}");
    }
}
