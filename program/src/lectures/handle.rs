//! Handles: the parameters of a figure that its reader can move.

use super::Result;
use super::content::FigureContent;
use alloc::vec::Vec;

/// The interactive part of a figure. The page makes it again whenever its reader moves a handle.
#[derive(Debug, serde::Serialize)]
pub struct Live {
    /// What the lecture says, with its equation.
    pub claim: &'static str,
    /// The handles.
    pub handles: &'static [Handle],
    /// The function that makes it from a value for each handle. It measures with the same code as
    /// the stored figure.
    #[serde(skip)]
    pub(super) make: fn(&mut FigureContent, &[f64]) -> Result,
}

impl Live {
    /// Draws and measures it for a value of each handle. A value out of range becomes the nearest
    /// allowed one. A missing value becomes the handle's start.
    ///
    /// # Errors
    /// As [`super::Figure::make`].
    pub fn make(&self, given: &[f64]) -> Result<FigureContent> {
        let mut content = FigureContent::default();
        (self.make)(&mut content, &self.values(given))?;
        Ok(content)
    }

    /// Returns an allowed value for each handle: the nearest to the value in `given`, or the
    /// handle's start.
    pub(super) fn values(&self, given: &[f64]) -> Vec<f64> {
        let handles = self.handles.iter().enumerate();
        let values = handles.map(|(i, handle)| handle.allowed(given.get(i).copied()));
        values.collect()
    }
}

/// A parameter that a reader can move: a slider, or a coordinate of a corner to drag.
#[derive(Debug, serde::Serialize)]
pub struct Handle {
    /// The name in links: lower case.
    pub name: &'static str,
    /// The name for people.
    pub label: &'static str,
    /// The unit; empty for a pure number.
    pub unit: &'static str,
    /// The least and the greatest value.
    pub range: [f64; 2],
    /// The distance between neighbouring values, which are multiples of it.
    pub step: f64,
    /// The value to start with.
    pub start: f64,
    /// The axis along which a reader drags it, `x` or `y`; `None` for a slider. A handle `x` and
    /// the handle `y` after it together are one corner of a polygon.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axis: Option<char>,
}

impl Handle {
    /// Makes a slider.
    pub(super) const fn slider(
        [name, label, unit]: [&'static str; 3],
        range: [f64; 2],
        step: f64,
        start: f64,
    ) -> Handle {
        Handle {
            name,
            label,
            unit,
            range,
            step,
            start,
            axis: None,
        }
    }

    /// Makes a coordinate of a corner to drag, in steps of 1/16.
    pub(super) const fn coordinate(
        [name, label]: [&'static str; 2],
        axis: char,
        range: [f64; 2],
        start: f64,
    ) -> Handle {
        Handle {
            name,
            label,
            unit: "",
            range,
            step: 1.0 / 16.0,
            start,
            axis: Some(axis),
        }
    }

    /// Makes a coordinate in steps of 1/256, for a point that the figure follows smoothly while it
    /// moves.
    pub(super) const fn fine_coordinate(
        names: [&'static str; 2],
        axis: char,
        range: [f64; 2],
        start: f64,
    ) -> Handle {
        Handle {
            step: 1.0 / 256.0,
            ..Handle::coordinate(names, axis, range, start)
        }
    }

    /// Returns the allowed value nearest to `value`, or the start if `value` is missing or not
    /// finite.
    pub(super) fn allowed(&self, value: Option<f64>) -> f64 {
        let [least, most] = self.range;
        let value = value.filter(|value| value.is_finite());
        let steps = libm::round(value.unwrap_or(self.start) / self.step);
        (steps * self.step).clamp(least, most)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lectures::{FIGURES, Figure, LIVE};
    use crate::split_mix::SplitMix;

    #[test]
    fn values_are_brought_into_range() {
        let handle = Handle::slider(["angle", "angle", "°"], [5.0, 175.0], 5.0, 60.0);
        assert_eq!(handle.allowed(None), 60.0);
        assert_eq!(handle.allowed(Some(f64::NAN)), 60.0);
        assert_eq!(handle.allowed(Some(-1e300)), 5.0);
        assert_eq!(handle.allowed(Some(1e300)), 175.0);
        assert_eq!(handle.allowed(Some(61.0)), 60.0);
    }

    /// Every handle changes something, nothing fails at either end, and each live part has a
    /// finding.
    #[test]
    fn handles_change_what_is_shown_from_end_to_end() {
        for (name, live) in LIVE {
            let figure = Figure::named(name).expect("a figure has this name");
            assert!(figure.live.is_some_and(|l| core::ptr::eq(l, *live)));
            let start: Vec<f64> = live.handles.iter().map(|h| h.start).collect();
            let at_start = live.make(&start).expect("a figure");
            assert!(!at_start.findings.is_empty(), "{name}");
            assert_eq!(at_start, live.make(&[]).expect("the same"));
            for (i, handle) in live.handles.iter().enumerate() {
                assert_eq!(
                    handle.allowed(None),
                    handle.start,
                    "{name}: {}",
                    handle.name
                );
                let mut has_changed = false;
                for end in handle.range {
                    let mut values = start.clone();
                    values[i] = end;
                    let there = live
                        .make(&values)
                        .unwrap_or_else(|e| panic!("{name}: {} {end}: {e}", handle.name));
                    has_changed |= there != at_start;
                    for finding in &there.findings {
                        let key = &finding.key;
                        assert!(
                            finding.value.is_finite(),
                            "{name}: {} {end}: {key}",
                            handle.name
                        );
                    }
                }
                assert!(has_changed, "{name}: {}", handle.name);
            }
        }
        let live = FIGURES.iter().filter(|figure| figure.live.is_some());
        assert_eq!(live.count(), LIVE.len());
    }

    /// A reader may move handles anywhere, so a verdict needs a sentence for each case: no sentence
    /// may be marked as false.
    #[test]
    fn every_verdict_is_true_wherever_handles_are() {
        let mut random = SplitMix(32);
        for (name, live) in LIVE {
            for _ in 0..60 {
                let mut anywhere = |handle: &Handle| {
                    let [least, most] = handle.range;
                    least + (most - least) * (random.next() >> 11) as f64 / (1u64 << 53) as f64
                };
                let values: Vec<f64> = live.handles.iter().map(&mut anywhere).collect();
                for finding in live.make(&values).expect("a figure").findings {
                    let is_marked = finding.verdict.starts_with("This does not hold");
                    assert!(!is_marked, "{name} {values:?}: {}", finding.key);
                }
            }
        }
    }
}
