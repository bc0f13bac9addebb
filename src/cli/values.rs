//! Values of flags: numbers in a row, sizes, lights, words.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use fastphong::scene::file::value::{Choice, Located, OneOrThree};
use fastphong::scene::file::{LightSection, NormalChoice};

/// Numbers between commas. Whether they make sense is asked where scene files are checked too.
fn list(text: &str) -> Option<Vec<f64>> {
    text.split(',')
        .map(|number| number.trim().parse().ok())
        .collect()
}

/// `x,y,z`.
pub fn triple(text: &str) -> Result<[f64; 3], String> {
    let numbers = list(text).and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| "expected three numbers x,y,z".to_owned())
}

/// `azimuth,elevation`.
pub fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers = list(text).and_then(|numbers| numbers.try_into().ok());
    numbers.ok_or_else(|| "expected two numbers azimuth,elevation".to_owned())
}

/// One number, or three between commas.
pub fn one_or_three(text: &str) -> Result<OneOrThree, String> {
    match list(text).as_deref() {
        Some(&[value]) => Ok(OneOrThree::splat(value)),
        Some(&[r, g, b]) => Ok(OneOrThree([r, g, b])),
        _ => Err("expected one number, or three r,g,b".to_owned()),
    }
}

/// `1920x1080` or `1920,1080`.
pub fn size(text: &str) -> Result<[i64; 2], String> {
    let sides = text.split_once(['x', 'X', ',']);
    let sides = sides.and_then(|(w, h)| Some([w.trim().parse().ok()?, h.trim().parse().ok()?]));
    sides.ok_or_else(|| "expected WIDTHxHEIGHT, for example 640x480".to_owned())
}

/// `x,y,z` with an intensity or a colour after it.
pub fn light(text: &str) -> Result<LightSection, String> {
    light_of(text, "--light", LightSection::toward).ok_or_else(|| {
        "expected a direction x,y,z, with an intensity or a colour r,g,b after it".to_owned()
    })
}

/// The same for a light at a position.
pub fn light_at(text: &str) -> Result<LightSection, String> {
    light_of(text, "--light-at", LightSection::at).ok_or_else(|| {
        "expected a position x,y,z, with an intensity or a colour r,g,b after it".to_owned()
    })
}

fn light_of(
    text: &str,
    flag: &str,
    light: fn(Located<[f64; 3]>) -> LightSection,
) -> Option<LightSection> {
    let numbers = list(text).unwrap_or_default();
    let at = |[x, y, z]: [f64; 3]| light(Located::flag([x, y, z], flag));
    match numbers[..] {
        [x, y, z] => Some(at([x, y, z])),
        [x, y, z, intensity] => Some(LightSection {
            intensity: Some(Located::flag(intensity, flag)),
            ..at([x, y, z])
        }),
        [x, y, z, r, g, b] => Some(LightSection {
            colour: Some(Located::flag(OneOrThree([r, g, b]), flag)),
            ..at([x, y, z])
        }),
        _ => None,
    }
}

/// Where vertex normals come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Normals {
    /// By a word of the scene file.
    Choice(NormalChoice),
    /// Averaged up to so many degrees.
    Crease(f64),
}

/// `averaged`, `given` or `crease=DEGREES`.
pub fn normals(text: &str) -> Result<Normals, String> {
    let crease = text
        .strip_prefix("crease=")
        .and_then(|degrees| degrees.parse().ok())
        .map(Normals::Crease);
    let choice = || NormalChoice::from_word(text).map(Normals::Choice);
    crease
        .or_else(choice)
        .ok_or_else(|| "expected `averaged`, `given` or `crease=DEGREES`".to_owned())
}

/// Grey levels of a threshold: 0 or more.
pub fn grey_levels(text: &str) -> Result<f64, String> {
    let levels = text.parse().ok().filter(|levels: &f64| *levels >= 0.0);
    levels.ok_or_else(|| "expected grey levels: a number, 0 or more".to_owned())
}

/// A scale of grey levels: more than 0.
pub fn scale(text: &str) -> Result<f32, String> {
    let scale = text
        .parse()
        .ok()
        .filter(|scale: &f32| *scale > 0.0 && scale.is_finite());
    scale.ok_or_else(|| "expected grey levels: a number over 0".to_owned())
}

/// A length in world units: more than 0.
pub fn length(text: &str) -> Result<f64, String> {
    let length = text
        .parse()
        .ok()
        .filter(|length: &f64| *length > 0.0 && length.is_finite());
    length.ok_or_else(|| "expected a length in world units: a number over 0".to_owned())
}

/// One of the words of a scene file.
pub fn word<T: Choice + Send + Sync>() -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(T::WORDS)
        .try_map(|word| T::from_word(&word).ok_or_else(|| format!("`{word}` is none of the words")))
}
