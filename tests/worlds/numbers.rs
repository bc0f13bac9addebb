//! Strategies for numbers, vectors and colours, and their text in a scene file.

use proptest::prelude::*;

/// Returns numbers around 1: multiples of a half, many of which are equal, and any numbers between
/// -2 and 2.
pub fn number() -> BoxedStrategy<f64> {
    prop_oneof![
        2 => (-4..=4).prop_map(|halves| f64::from(halves) / 2.0),
        3 => -2.0..2.0,
    ]
    .boxed()
}

/// Returns numbers over 0. Each power of ten between the two exponents is equally likely.
pub fn size(exponents: std::ops::Range<f64>) -> BoxedStrategy<f64> {
    exponents
        .prop_map(|exponent| 10.0f64.powf(exponent))
        .boxed()
}

/// Returns numbers of any size and sign, mostly around 1.
pub fn any_size() -> BoxedStrategy<f64> {
    prop_oneof![
        8 => number(),
        1 => (number(), size(-8.0..8.0)).prop_map(|(number, size)| number * size),
    ]
    .boxed()
}

/// Returns vectors of such numbers.
pub fn triple(number: BoxedStrategy<f64>) -> BoxedStrategy<[f64; 3]> {
    [number.clone(), number.clone(), number].boxed()
}

/// Returns colours and coefficients. Some are grey, and most are at most 1.
pub fn colour() -> BoxedStrategy<[f64; 3]> {
    prop_oneof![
        2 => prop::sample::select(vec![0.0, 0.5, 1.0]).prop_map(|grey| [grey; 3]),
        4 => [0.0..1.0, 0.0..1.0, 0.0..1.0],
        1 => [0.0..4.0, 0.0..4.0, 0.0..4.0],
    ]
    .boxed()
}

/// Returns `[x, y, z]`.
pub fn text(vector: [f64; 3]) -> String {
    format!("{vector:?}")
}
