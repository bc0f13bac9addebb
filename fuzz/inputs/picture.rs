//! Picture files: comparing any two files returns an error, or metrics and maps.
//!
//! The first two bytes are the length of the first file.

use fastphong::compare::metrics::{
    METRICS, compare, difference_map, flip_colours, flip_map, mean_flip, signed_difference_map,
};
use fastphong::picture::image_file::{FilePicture, Format, Pair, decode_picture};

/// Larger pictures are read but not compared. A header may announce 2²⁶ pixels in a few bytes, for
/// which a reader allocates memory.
const MOST_PIXELS: usize = 64 * 48;

pub fn run(bytes: &[u8]) {
    let Some((&[low, high], files)) = bytes.split_first_chunk::<2>() else {
        return;
    };
    let first = usize::from(u16::from_le_bytes([low, high])).min(files.len());
    let (first, second) = files.split_at(first);
    let first = decode_picture(first);
    // If the second file is empty, the first one is compared with itself.
    let second = match second {
        [] => first.clone(),
        second => decode_picture(second),
    };
    let (first, second) = match (first, second) {
        (Ok(first), Ok(second)) => (first, second),
        (Err(error), _) | (_, Err(error)) => {
            assert!(!error.to_string().is_empty());
            return;
        }
    };
    if [&first, &second]
        .iter()
        .any(|p| p.size()[0] * p.size()[1] > MOST_PIXELS)
    {
        return;
    }
    check_pair(&first, &second);
    check_pair(&first, &first);
    check_round_trip(&first);
}

fn check_pair(first: &FilePicture, second: &FilePicture) {
    let pair = Pair::new(first, second, None);
    let [r, a] = pair.compared();
    let difference = compare(&r, &a).expect("the common part has one size");
    let are_finite = [first, second].iter().all(|picture| {
        let picture = picture.to_linear();
        picture.pixels().iter().flatten().all(|c| c.is_finite())
    });
    for metric in METRICS {
        if let Some(value) = (metric.value)(&difference) {
            let is_wrong = are_finite && value.is_nan();
            assert!(!is_wrong, "{} is not a number", metric.name);
        }
    }
    let maps = [
        difference_map(&r, &a, 16.0),
        signed_difference_map(&r, &a, 16.0),
    ];
    assert!(maps.iter().all(Result::is_ok));
    let [seen, other] = pair.displayed();
    let flip = flip_map(&seen, &other).expect("the common part has one size");
    assert!((0.0..=1.0).contains(&mean_flip(&flip)));
    flip_colours(&flip);
}

/// Checks, in every format, that a picture that was written is read unchanged.
fn check_round_trip(picture: &FilePicture) {
    for format in Format::ALL {
        let bytes = picture.encode(format).expect("a picture with pixels");
        let again = decode_picture(&bytes).expect("a file that was written here");
        assert_eq!(again.size(), picture.size());
        let bytes_again = again.encode(format).expect("a picture with pixels");
        assert!(bytes == bytes_again, "{format:?}");
    }
}
