//! What all scenes together say: the answer to the lecture's Programming Project, in numbers.

use super::section::{Section, row_name};
use crate::compare::comparison::RowData;
use alloc::string::String;
use alloc::vec::Vec;

/// The methods that the Programming Project of the lecture compares, in its order, with its names for them.
pub(super) const PROJECT: [(&str, &str); 4] = [
    ("gouraud", "Gouraud"),
    ("naive-phong", "naive Phong"),
    ("fast-phong", "fast Phong"),
    ("slerp-phong", "slerp Phong"),
];

/// How fast a method is against naive Phong, over all scenes in which both were timed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tally<'a> {
    /// Scenes in which it is faster, slower, and neither for sure.
    pub faster: usize,
    pub slower: usize,
    pub ties: usize,
    /// The geometric mean of the ratios: that of the inverse ratios is its inverse, so that it favours nobody.
    pub mean: f64,
    /// The largest ratio and its scene.
    pub best: (f64, &'a str),
    /// The smallest one.
    pub worst: (f64, &'a str),
}

impl<'a> Tally<'a> {
    /// That of `method` with its default parameters drawn by scanlines; `None` if it was never timed.
    pub fn of(method: &str, sections: &'a [Section]) -> Option<Tally<'a>> {
        let timed = sections.iter().filter_map(|section| {
            let ratio = section.row(method)?.speed.as_ref()?.ratio_to_naive?;
            Some((ratio, section.caption.title.as_str()))
        });
        let (mut logarithms, mut tally) = (Vec::new(), None);
        for (ratio, title) in timed {
            let here = (ratio.ratio.median, title);
            let none = Tally {
                faster: 0,
                slower: 0,
                ties: 0,
                mean: 1.0,
                best: here,
                worst: here,
            };
            let tally = tally.get_or_insert(none);
            match () {
                () if ratio.tie => tally.ties += 1,
                () if ratio.ratio.median > 1.0 => tally.faster += 1,
                () => tally.slower += 1,
            }
            if here.0 > tally.best.0 {
                tally.best = here;
            }
            if here.0 < tally.worst.0 {
                tally.worst = here;
            }
            logarithms.push(libm::log(here.0));
        }
        let mut tally = tally?;
        tally.mean = geometric_mean(&logarithms);
        Some(tally)
    }

    /// Scenes in which it was timed.
    pub fn scenes(&self) -> usize {
        self.faster + self.slower + self.ties
    }
}

fn geometric_mean(logarithms: &[f64]) -> f64 {
    libm::exp(logarithms.iter().sum::<f64>() / logarithms.len() as f64)
}

/// The largest error of a method over all scenes, in 0..=1, and its scene; `None` if it was not compared.
pub(super) fn worst_error<'a>(method: &str, sections: &'a [Section]) -> Option<(f64, &'a str)> {
    let errors = sections.iter().filter_map(|s| {
        Some((
            s.row(method)?.error.difference.max,
            s.caption.title.as_str(),
        ))
    });
    errors.max_by(|a, b| a.0.total_cmp(&b.0))
}

/// A method over all scenes: time against naive Phong and error.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Overall {
    /// What it is called, with its engine.
    pub name: String,
    /// The geometric mean of its time divided by that of naive Phong.
    pub time: f64,
    /// The quadratic mean of its RMS errors, in 0..=1: scenes count alike, whatever they cover.
    pub rms: f64,
    /// True if the barycentric renderer drew it.
    pub is_barycentric: bool,
}

/// All methods that were timed in every scene.
pub(super) fn overall(sections: &[Section]) -> Vec<Overall> {
    let Some(first) = sections.first() else {
        return Vec::new();
    };
    first
        .all_rows()
        .filter_map(|row| of_all_scenes(row, sections))
        .collect()
}

fn of_all_scenes(row: &RowData, sections: &[Section]) -> Option<Overall> {
    let (mut logarithms, mut squares) = (Vec::new(), 0.0);
    for section in sections {
        let same = section
            .all_rows()
            .find(|r| r.variant == row.variant && r.is_barycentric() == row.is_barycentric())?;
        logarithms.push(-libm::log(
            same.speed.as_ref()?.ratio_to_naive?.ratio.median,
        ));
        squares += same.error.difference.rms * same.error.difference.rms;
    }
    Some(Overall {
        name: row_name(row),
        time: geometric_mean(&logarithms),
        rms: libm::sqrt(squares / sections.len() as f64),
        is_barycentric: row.is_barycentric(),
    })
}
