use alloc::vec::Vec;

use super::judged_map::{FRAME, LEFT_OUT};
use super::*;
use crate::compare::metrics::map::{BEYOND, COVERAGE, EQUAL, difference_map};
use crate::picture::{Picture, Picture8};

const BLACK: [u8; 4] = [0, 0, 0, 255];
const WHITE: [u8; 4] = [255; 4];

/// Makes a picture of a drawing: `#` is white, `.` black, a space is covered by nothing, and a
/// digit d is a grey of 10 d levels.
fn drawn(rows: &[&str]) -> Picture8 {
    let pixel = |letter: u8| match letter {
        b'#' => WHITE,
        b'.' => BLACK,
        b' ' => [0; 4],
        digit => {
            let level = 10 * (digit - b'0');
            [level, level, level, 255]
        }
    };
    let pixels = rows.iter().flat_map(|row| row.bytes().map(pixel));
    Picture8::from_pixels(rows[0].len(), rows.len(), pixels.collect()).expect("whole rows")
}

fn judged(reference: &Picture8, actual: &Picture8, threshold: f64, radius: usize) -> Judgement {
    let selection = Selection::whole([reference.width(), reference.height()]);
    judge(reference, actual, Rule { threshold, radius }, &selection).expect("one size")
}

/// Returns pseudo-random values, always the same ones.
fn noise(seed: u64) -> impl FnMut() -> u64 {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state >> 11
    }
}

#[test]
fn pixels_over_the_threshold_are_counted_and_those_at_it_are_not() {
    let reference = drawn(&["000", "000"]);
    let actual = drawn(&["012", "003"]);
    for (threshold, over) in [(0.0, 3), (9.9, 3), (10.0, 2), (20.0, 1), (30.0, 0)] {
        let judgement = judged(&reference, &actual, threshold, 0);
        assert_eq!(judgement.over, over, "{threshold}");
        assert_eq!(judgement.region.map_or(0, |region| region.pixels), over);
        assert_eq!((judgement.compared, judgement.left_out), (6, 0));
        assert_eq!((judgement.largest, judgement.worst), (30.0, Some([2, 1])));
    }
    let none = judged(&reference, &reference, 0.0, 0);
    assert_eq!((none.over, none.worst, none.region), (0, None, None));
}

#[test]
fn what_nothing_covers_is_not_compared() {
    let picture = drawn(&["  1", "   "]);
    assert_eq!(judged(&picture, &picture, 0.0, 0).compared, 1);
    let nothing = Picture8::new(0, 0, BLACK);
    assert_eq!(judged(&nothing, &nothing, 0.0, 2), Judgement::default());
}

#[test]
fn an_edge_that_moved_matches_within_the_radius() {
    let reference = drawn(&["..####", "..####"]);
    let actual = drawn(&["....##", "....##"]);
    let over = [0, 1, 2, 3].map(|radius| judged(&reference, &actual, 0.0, radius).over);
    // With a radius of 1, each of the two columns between the edges has a neighbour of the other
    // colour in one picture only.
    assert_eq!(over, [4, 4, 0, 0]);
}

/// The error is symmetric: a picture that lacks something is as wrong as one that adds it.
#[test]
fn a_line_that_one_picture_lacks_is_not_hidden_by_any_radius() {
    let line = drawn(&[".......", ".#####.", "......."]);
    let none = drawn(&[".......", ".......", "......."]);
    for radius in 0..=MAX_RADIUS {
        for [reference, actual] in [[&line, &none], [&none, &line]] {
            let judgement = judged(reference, actual, 2.0, radius);
            assert_eq!((judgement.over, judgement.largest), (5, 255.0), "{radius}");
        }
    }
    // Of two lines a pixel apart, one may go within a radius of 2: this is what the radius says.
    let two = drawn(&[".......", ".#####.", ".......", ".#####.", "......."]);
    let one = drawn(&[".......", ".#####.", ".......", ".......", "......."]);
    assert_eq!(
        [1, 2].map(|radius| judged(&two, &one, 2.0, radius).over),
        [5, 0]
    );
}

#[test]
fn an_edge_of_what_is_covered_may_move_too() {
    let reference = drawn(&["  ####", "  ####"]);
    let actual = drawn(&["   ###", "   ###"]);
    assert_eq!(
        [0, 1].map(|radius| judged(&reference, &actual, 0.0, radius).over),
        [2, 0]
    );
}

/// The definition, by looking at all pixels.
fn error_by_definition(pictures: [&Picture8; 2], at: [usize; 2], radius: usize) -> Option<f64> {
    let between = |a: [u8; 4], b: [u8; 4]| match [a[3], b[3]] {
        [0, 0] => None,
        [0, other] | [other, 0] => Some(f64::from(other)),
        _ => (0..4)
            .map(|c| f64::from(a[c].abs_diff(b[c])))
            .reduce(f64::max),
    };
    let [x, y] = at;
    let [reference, actual] = pictures.map(|picture| picture.get(x, y));
    between(reference, actual)?;
    let least = |pixel, picture: &Picture8| {
        let near = |a: usize, b: usize| a.abs_diff(b) <= radius;
        let rows = (0..picture.height()).filter(|row| near(*row, y));
        let around = rows.flat_map(|row| {
            let columns = (0..picture.width()).filter(|column| near(*column, x));
            columns.map(move |column| (column, row))
        });
        let errors = around.map(|(x, y)| between(pixel, picture.get(x, y)).unwrap_or(0.0));
        errors.fold(f64::INFINITY, f64::min)
    };
    Some(least(reference, pictures[1]).max(least(actual, pictures[0])))
}

#[test]
fn errors_within_a_radius_are_those_of_the_definition() {
    let sizes = [[1, 1], [2, 5], [9, 4], [13, 11], [1, 20], [20, 1]];
    for (seed, [width, height]) in sizes.into_iter().enumerate() {
        let mut next = noise(seed as u64 + 1);
        let mut picture = || {
            let pixels = (0..width * height).map(|_| {
                let random = next();
                let alpha = if random.is_multiple_of(7) { 0 } else { 255 };
                [(random >> 8) as u8 % 4, (random >> 16) as u8 % 4, 9, alpha]
            });
            Picture8::from_pixels(width, height, pixels.collect()).expect("whole rows")
        };
        let [reference, actual] = [picture(), picture()];
        let selection = Selection::whole([width, height]);
        for radius in [0, 1, 2, 5, MAX_RADIUS] {
            let mut rows = 0;
            for_each_error_row(&reference, &actual, radius, &selection, |y, errors| {
                for (x, error) in errors.iter().enumerate() {
                    let expected = error_by_definition([&reference, &actual], [x, y], radius);
                    assert_eq!(*error, expected, "{width}x{height}, {radius}: {x}, {y}");
                }
                rows += 1;
            });
            assert_eq!(rows, height);
        }
    }
}

/// Finds the largest region by filling each one.
fn largest_by_filling(over: &Picture<bool>) -> Option<(usize, [usize; 2], [usize; 2])> {
    let mut left = over.clone();
    let mut largest: Option<(usize, [usize; 2], [usize; 2])> = None;
    for (y, x) in (0..over.height()).flat_map(|y| (0..over.width()).map(move |x| (y, x))) {
        let mut pixels = Vec::new();
        let mut next = Vec::from([(x, y)]);
        while let Some((x, y)) = next.pop() {
            if x >= over.width() || y >= over.height() || !left.get(x, y) {
                continue;
            }
            left.row_mut(y)[x] = false;
            pixels.push([x, y]);
            for (dx, dy) in (0..3).flat_map(|dx| (0..3).map(move |dy| (dx, dy))) {
                next.push(((x + dx).wrapping_sub(1), (y + dy).wrapping_sub(1)));
            }
        }
        let ends = [0, 1].map(|axis| {
            let places = pixels.iter().map(|pixel| pixel[axis]);
            (places.clone().min(), places.max())
        });
        if let [(Some(left), Some(right)), (Some(top), Some(bottom))] = ends {
            let corner = [left, top];
            let size = [right - left + 1, bottom - top + 1];
            let is_before = largest.is_none_or(|(most, other, _)| {
                pixels.len() > most || pixels.len() == most && [top, left] < [other[1], other[0]]
            });
            if is_before {
                largest = Some((pixels.len(), corner, size));
            }
        }
    }
    largest
}

#[test]
fn the_largest_region_is_the_one_that_filling_finds() {
    for seed in 1..400 {
        let mut next = noise(seed);
        let (width, height) = (1 + next() as usize % 24, 1 + next() as usize % 24);
        let share = 1 + next() % 9;
        let pixels = (0..width * height).map(|_| next() % 10 < share);
        let over = Picture::from_pixels(width, height, pixels.collect()).expect("whole rows");
        let reference = Picture8::new(width, height, BLACK);
        let actual = over.map(|over| if over { WHITE } else { BLACK });
        let region = judged(&reference, &actual, 0.0, 0).region;
        let found = region.map(|region| (region.pixels, region.corner, region.size));
        assert_eq!(found, largest_by_filling(&over), "seed {seed}");
    }
}

#[test]
fn pixels_that_touch_at_a_corner_are_connected() {
    let reference = drawn(&[".....", ".....", "....."]);
    let actual = drawn(&["1.1..", ".2...", "1.1.3"]);
    let judgement = judged(&reference, &actual, 0.0, 0);
    let expected = LargestRegion {
        pixels: 5,
        corner: [0, 0],
        size: [3, 3],
        worst: [1, 1],
        levels: 20.0,
    };
    assert_eq!(judgement.region, Some(expected));
    assert_eq!(judgement.worst, Some([4, 2]), "of all pixels");
}

/// Regions that meet further down, in the shape of a comb and of a spiral, are one.
#[test]
fn regions_that_meet_late_are_one_with_its_first_worst_pixel() {
    let actual = drawn(&["1.1.3.3", "1.1.1.1", "1111111", ".......", "3......"]);
    let reference = drawn(&["......."; 5]);
    let region = judged(&reference, &actual, 0.0, 0)
        .region
        .expect("a region");
    assert_eq!((region.pixels, region.size), (15, [7, 3]));
    assert_eq!((region.worst, region.levels), ([4, 0], 30.0));
}

#[test]
fn pixels_that_are_left_out_are_not_judged_but_may_be_matched() {
    let reference = drawn(&["..##", "...."]);
    let actual = drawn(&[".###", "...#"]);
    let rule = |radius| Rule {
        threshold: 0.0,
        radius,
    };
    // Transparent and black pixels are left out, dark ones are not.
    let mask = Mask::of(&drawn(&["#1##", "## ."]));
    let selection = Selection::new([4, 2], None, Some(&mask)).expect("one size");
    let judgement = judge(&reference, &actual, rule(0), &selection).unwrap();
    assert_eq!(
        (judgement.compared, judgement.left_out, judgement.over),
        (6, 2, 1)
    );
    assert_eq!(judgement.worst, Some([1, 0]));
    let area = Area {
        corner: [2, 0],
        size: [2, 2],
    };
    let selection = Selection::new([4, 2], Some(area), Some(&mask)).expect("one size");
    let judgement = judge(&reference, &actual, rule(0), &selection).unwrap();
    assert_eq!(
        (judgement.compared, judgement.left_out, judgement.over),
        (2, 6, 0)
    );
    // Only the pixel at column 1 is judged: its like is at column 2.
    let area = Area {
        corner: [1, 0],
        size: [1, 1],
    };
    let selection = Selection::new([4, 2], Some(area), None).expect("within");
    let over = [0, 1].map(|radius| {
        judge(&reference, &actual, rule(radius), &selection)
            .unwrap()
            .over
    });
    assert_eq!(over, [1, 0]);
}

#[test]
fn an_area_beyond_the_picture_and_a_mask_of_another_size_select_nothing() {
    let area = |x, y, width, height| Area {
        corner: [x, y],
        size: [width, height],
    };
    let selects = |area| Selection::new([4, 3], Some(area), None).is_some();
    assert!(selects(area(0, 0, 4, 3)) && selects(area(3, 2, 1, 1)));
    for area in [
        area(1, 0, 4, 3),
        area(0, 3, 1, 1),
        area(usize::MAX, 0, 2, 1),
    ] {
        assert!(!selects(area), "{area:?}");
    }
    let mask = Mask::of(&drawn(&["#"]));
    assert!(Selection::new([4, 3], None, Some(&mask)).is_none());
}

#[test]
fn an_infinite_error_is_over_any_threshold_and_matches_its_like() {
    let pixel = |level: f32| [level, 0.0, 0.0, 1.0];
    let reference = Picture::from_pixels(3, 1, [1.0, f32::NAN, 0.0].map(pixel).to_vec()).unwrap();
    let actual = Picture::from_pixels(3, 1, [1.0, 0.0, f32::NAN].map(pixel).to_vec()).unwrap();
    let selection = Selection::whole([3, 1]);
    let judged = |radius| {
        let rule = Rule {
            threshold: f64::INFINITY,
            radius,
        };
        judge(&reference, &actual, rule, &selection).unwrap()
    };
    let judgement = judged(0);
    assert_eq!((judgement.over, judgement.histogram.not_finite), (2, 2));
    assert_eq!(
        (judgement.largest, judgement.worst),
        (f64::INFINITY, Some([1, 0]))
    );
    assert_eq!(judged(1).over, 0);
}

#[test]
fn maps_show_what_is_left_of_the_differences() {
    let reference = drawn(&["..##..", ".....1", "     1"]);
    let actual = drawn(&[".##...", ".9...2", "1    2"]);
    let area = Area {
        corner: [0, 0],
        size: [2, 3],
    };
    let part = Selection::new([6, 3], Some(area), None).unwrap();
    let whole = Selection::whole([6, 3]);
    let map = |radius, selection| judged_map(&reference, &actual, 16.0, radius, selection).unwrap();
    let at = |map: &Picture8| [map.get(1, 0), map.get(1, 1), map.get(0, 2), map.get(5, 1)];
    let plain = map(0, &whole);
    assert_eq!(plain, difference_map(&reference, &actual, 16.0).unwrap());
    let [edge, grey, covered, one] = at(&map(1, &whole));
    assert_ne!(at(&plain)[0], EQUAL);
    // The grey pixel is 90 levels off in either direction, and the last one 10.
    assert_eq!([edge, covered, one], [EQUAL, COVERAGE, at(&plain)[3]]);
    assert_eq!(grey, BEYOND);
    let mut map = map(1, &part);
    assert_eq!([map.get(1, 0), map.get(1, 1)], [EQUAL, BEYOND]);
    assert_eq!([map.get(2, 0), map.get(5, 2)], [LEFT_OUT; 2]);
    let region = LargestRegion {
        pixels: 1,
        corner: [0, 1],
        size: [2, 2],
        worst: [0, 1],
        levels: 1.0,
    };
    let inside = map.get(1, 2);
    draw_frame(&mut map, &region);
    // The left and the lower side of the frame are beyond the map.
    assert_eq!([map.get(0, 0), map.get(2, 0), map.get(2, 2)], [FRAME; 3]);
    assert_eq!((map.get(1, 2), map.get(3, 0)), (inside, LEFT_OUT));
}
