//! Compares today's pictures with the blessed ones, for every shipped scene, method, engine and
//! instruction set of this machine, and for the reference.
//!
//! `tests/references` has a picture of each closed form, `SCENE/reference-MODEL.png`, and
//! `SCENE/METHOD.png` for each method that is more than a level off its closed form. A method
//! without its own picture is compared with the picture of its closed form. `pins.rs` beside this
//! file holds every picture to the bit.
//!
//! `FASTPHONG_BLESS=1 cargo test --test conformance regression` blesses today's pictures. Look at
//! each before committing it. Pixels are compared after decoding. A channel may differ by one
//! level, because a value within rounding of a half can be stored as either level if the compiler
//! reorders the reference's operations or another engine draws it.

use crate::support::cases::{Case, case, cases};
use crate::support::differences::levels_apart;
use crate::support::drawings::for_each_drawing;
use fastphong::compare::metrics::difference_map;
use fastphong::picture::Picture8;
use fastphong::picture::encoding::store as store_levels;
use fastphong::picture::image_file::{encode_png, read_picture, write_file};
use fastphong::reference::Model;
use std::fs;
use std::path::{Path, PathBuf};

const SIZE: (i64, i64) = (128, 96);

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn store(path: &Path, picture: &Picture8) {
    fs::create_dir_all(path.parent().expect("a folder")).expect("a writable target folder");
    write_file(path, &encode_png(picture).expect("a picture with pixels"))
        .expect("a writable file");
}

/// Returns the path of a blessed picture.
fn blessed(scene: &str, name: &str) -> PathBuf {
    folder("tests/references").join(format!("{scene}/{name}.png"))
}

/// Returns the picture of a closed form, and the path of the blessed one.
fn form(case: &Case, model: Model) -> (Picture8, PathBuf) {
    let name = format!("reference-{}", model.name());
    let picture = store_levels(case.truth(model), case.frame.encoding());
    (picture, blessed(&case.name, &name))
}

/// True if the comparison accepts this difference.
fn is_alike((levels, uncovered): (u8, usize)) -> bool {
    levels <= 1 && uncovered == 0
}

/// Compares colours where `counts` holds, and coverage everywhere. If they differ, writes `actual`
/// and the difference, and returns a message.
fn check(
    name: &str,
    blessed: &Path,
    actual: &Picture8,
    counts: impl Fn(usize, usize) -> bool,
) -> Option<String> {
    let output = folder("target/regression").join(format!("{name}.actual.png"));
    let expected = match read_picture(blessed).map(|picture| picture.to_stored()) {
        Ok(expected) => expected,
        Err(error) => {
            store(&output, actual);
            return Some(format!(
                "{name}: {error}; the candidate is {}",
                output.display()
            ));
        }
    };
    let (levels, uncovered) = levels_apart(&expected, actual, counts);
    if is_alike((levels, uncovered)) {
        return None;
    }
    let map = folder("target/regression").join(format!("{name}.difference.png"));
    store(&output, actual);
    store(
        &map,
        &difference_map(&expected, actual, 16.0).expect("equal sizes"),
    );
    Some(format!(
        "{name}: off by {levels} levels from {}, {uncovered} pixels drawn in one only; see {} and {}",
        blessed.display(),
        output.display(),
        map.display()
    ))
}

#[test]
fn pictures_are_the_blessed_ones() {
    let blesses = std::env::var_os("FASTPHONG_BLESS").is_some();
    if blesses {
        fs::remove_dir_all(folder("tests/references")).expect("the folder of blessed pictures");
    }
    let check_or_bless = |name: &str, file: &Path, actual: &Picture8| {
        if blesses {
            store(file, actual);
            return None;
        }
        check(name, file, actual, |_, _| true)
    };
    let (mut failures, mut known) = (Vec::new(), Vec::new());
    for case in cases(Some(SIZE)) {
        for model in Model::ALL {
            let (picture, file) = form(case, model);
            let name = format!("{}/reference-{}", case.name, model.name());
            failures.extend(check_or_bless(&name, &file, &picture));
            known.push(file);
        }
    }
    // The span engine draws the blessed picture. Other engines may differ where rounding decides
    // visibility.
    let drawn = for_each_drawing(cases(Some(SIZE)), |drawing| {
        let (name, case, info) = (drawing.to_string(), drawing.case, drawing.variant.info());
        let (picture, (truth, file)) = (drawing.stored(), form(case, info.model));
        let own = blessed(&case.name, info.name);
        if drawing.is_by_spans() && !is_alike(levels_apart(&truth, &picture, |_, _| true)) {
            let file = if blesses || own.exists() { &own } else { &file };
            return (check_or_bless(&name, file, &picture), Some(own));
        }
        let file = if own.exists() { &own } else { &file };
        let decided = case.decided();
        let counts = |x, y| drawing.is_by_spans() || decided.get(x, y);
        (check(&name, file, &picture, counts), None)
    });
    for (failure, own) in drawn {
        failures.extend(failure);
        known.extend(own);
    }
    // A blessed picture that nothing renders any more could never fail.
    for folder in fs::read_dir(folder("tests/references"))
        .expect("the folder of blessed pictures")
        .flatten()
    {
        for file in fs::read_dir(folder.path()).into_iter().flatten().flatten() {
            if !known.contains(&file.path()) {
                failures.push(format!(
                    "{} belongs to no closed form, and to no method that is off its own",
                    file.path().display()
                ));
            }
        }
    }
    assert!(
        failures.is_empty(),
        "{} pictures differ:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// The comparison rejects a pixel that is off by two levels and another method's picture.
#[test]
fn the_comparison_detects_two_levels() {
    let frame = &case("coarse-sphere", Some(SIZE)).frame;
    let picture = |name: &str| {
        fastphong::shading::Variant::parse(name)
            .expect("a method")
            .render(frame)
            .expect("a method for the frame")
    };
    let naive = picture("naive-phong");
    let mut moved = naive.clone();
    let lit = moved
        .pixels()
        .iter()
        .position(|t| t[0] > 100 && t[0] < 250)
        .expect("a lit pixel");
    moved.pixels_mut()[lit][0] += 2;
    let levels = |other: &Picture8| levels_apart(&naive, other, |_, _| true).0;
    assert!(levels(&moved) > 1);
    assert!(levels(&picture("gouraud")) > 1);
    assert!(levels(&picture("fast-phong")) <= 1);
}
