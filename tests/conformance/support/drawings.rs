//! One sweep over frames, methods and renderers for all tests that check something on every
//! drawing.

use super::cases::Case;
use super::renderers::{self, distinct};
use fastphong::picture::{LinearPicture, Picture8};
use fastphong::raster::{Plan, Renderer};
use fastphong::shading::{METHODS, Variant};
use rayon::prelude::*;
use std::fmt;

/// A frame drawn by a method and a renderer.
pub struct Drawing<'a> {
    pub case: &'a Case,
    pub variant: Variant,
    pub renderer: Renderer,
}

impl Drawing<'_> {
    /// Draws it in linear colours, before rounding.
    pub fn linear(&self) -> LinearPicture {
        self.variant
            .render_linear_with(&self.case.frame, self.renderer)
            .expect("a method for the frame")
    }

    /// Draws it in stored levels.
    pub fn stored(&self) -> Picture8 {
        let picture = self.variant.render_with(&self.case.frame, self.renderer);
        picture.expect("a method for the frame")
    }

    /// True for the scalar span engine, with which the others are compared.
    pub fn is_by_spans(&self) -> bool {
        self.renderer == Renderer::LECTURE
    }
}

/// Writes `SCENE/METHOD by ENGINE on INSTRUCTIONS`.
impl fmt::Display for Drawing<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (scene, method) = (&self.case.name, self.variant.info().name);
        write!(f, "{scene}/{method} by {}", renderers::name(self.renderer))
    }
}

/// Calls `look` for every method that can draw a case, and every renderer of this machine that
/// draws the case differently, the scalar span engine first. Returns the results in order. Methods
/// are drawn in parallel.
pub fn for_each_drawing<'a, T: Send>(
    cases: impl IntoIterator<Item = &'a Case>,
    look: impl Fn(&Drawing<'a>) -> T + Sync,
) -> Vec<T> {
    let mut found = Vec::new();
    for case in cases {
        // Make it before the threads below start: engines draw it on these threads, and none of
        // them may wait for it.
        case.seen();
        let drawn: Vec<Vec<T>> = METHODS
            .par_iter()
            .map(|entry| {
                let variant = entry.variant();
                let renderers = distinct(&variant, &case.frame);
                let is_refused = matches!(
                    variant.plan(&case.frame, Renderer::LECTURE),
                    Plan::Refused(_)
                );
                assert_eq!(renderers.is_empty(), is_refused, "{}", entry.info.name);
                let draw = |renderer| {
                    look(&Drawing {
                        case,
                        variant: variant.clone(),
                        renderer,
                    })
                };
                renderers.into_iter().map(draw).collect::<Vec<T>>()
            })
            .collect();
        found.extend(drawn.into_iter().flatten());
    }
    found
}

/// Fails with the messages of all drawings that returned one.
#[track_caller]
pub fn assert_none(failures: impl IntoIterator<Item = Option<String>>) {
    let failures: Vec<String> = failures.into_iter().flatten().collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
