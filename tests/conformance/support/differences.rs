//! Fast differences of two pictures for tests. They compute neither mean nor similarity, which
//! would take longer than drawing.

use fastphong::picture::{LinearPicture, Picture, Picture8};

/// Returns the largest difference of a channel where `counts` holds, and the count of all pixels
/// whose alpha differs because only one of the pictures covers them. Differences that are not
/// finite count as infinite.
pub fn largest_difference(
    truth: &LinearPicture,
    ours: &LinearPicture,
    counts: impl Fn(usize, usize) -> bool,
) -> (f64, usize) {
    assert_equal_sizes(truth, ours);
    let (mut most, mut uncovered) = (0.0f64, 0);
    for y in 0..truth.height() {
        for (x, (a, b)) in truth.row(y).iter().zip(ours.row(y)).enumerate() {
            uncovered += usize::from(a[3] != b[3]);
            if counts(x, y) {
                for c in 0..3 {
                    let difference = (f64::from(a[c]) - f64::from(b[c])).abs();
                    most = most.max(if difference.is_finite() {
                        difference
                    } else {
                        f64::INFINITY
                    });
                }
            }
        }
    }
    (most, uncovered)
}

/// Returns the largest difference of a colour where `counts` holds, in grey levels, and the count
/// of all pixels whose alpha differs.
pub fn levels_apart(
    expected: &Picture8,
    actual: &Picture8,
    counts: impl Fn(usize, usize) -> bool,
) -> (u8, usize) {
    assert_equal_sizes(expected, actual);
    let (mut most, mut uncovered) = (0, 0);
    for y in 0..expected.height() {
        for (x, (a, b)) in expected.row(y).iter().zip(actual.row(y)).enumerate() {
            uncovered += usize::from(a[3] != b[3]);
            if a != b && counts(x, y) {
                most = (0..3).fold(most, |most, c| most.max(a[c].abs_diff(b[c])));
            }
        }
    }
    (most, uncovered)
}

#[track_caller]
fn assert_equal_sizes<T: Copy>(a: &Picture<T>, b: &Picture<T>) {
    let size = |picture: &Picture<T>| (picture.width(), picture.height());
    assert_eq!(size(a), size(b), "pictures of different sizes");
}

/// Returns true at the covered pixels.
pub fn covered(picture: &LinearPicture) -> Picture<bool> {
    picture.map(|pixel| pixel[3] > 0.0)
}
