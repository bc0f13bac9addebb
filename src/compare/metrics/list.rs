//! The list of metrics. Everything that prints, tabulates or tests a difference uses it.

use super::Difference;

/// Which values of a metric are good.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[cfg_attr(feature = "io", serde(rename_all = "lowercase"))]
pub enum Better {
    /// The lower the better.
    Lower,
    /// The higher the better.
    Higher,
    /// The nearer to zero the better. The sign has a meaning.
    Zero,
}

/// The description of a metric: a value of a [`Difference`], converted to a unit for people.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "io", derive(serde::Serialize))]
#[non_exhaustive]
pub struct MetricInfo {
    /// The name on the command line and in tables.
    pub name: &'static str,
    /// The unit of `value`, or an empty text for a plain number.
    pub unit: &'static str,
    /// The meaning, in one line.
    pub meaning: &'static str,
    /// Which values are good.
    pub better: Better,
    /// Returns the value in `unit`, or `None` if the pictures do not have one.
    #[cfg_attr(feature = "io", serde(skip))]
    pub value: fn(&Difference) -> Option<f64>,
}

impl MetricInfo {
    /// Returns the metric with this name.
    pub fn named(name: &str) -> Option<&'static MetricInfo> {
        METRICS.iter().find(|metric| metric.name == name)
    }
}

/// How many grey levels the range of a channel has.
const LEVELS: f64 = 255.0;

/// All metrics, the most useful ones first.
pub static METRICS: &[MetricInfo] = &[
    MetricInfo {
        name: "max",
        unit: "levels",
        meaning: "largest error of a channel in any pixel",
        better: Better::Lower,
        value: |d| Some(LEVELS * d.max),
    },
    MetricInfo {
        name: "rms",
        unit: "levels",
        meaning: "root of the mean squared error over the covered pixels",
        better: Better::Lower,
        value: |d| Some(LEVELS * d.rms),
    },
    MetricInfo {
        name: "mae",
        unit: "levels",
        meaning: "mean absolute error over the covered pixels",
        better: Better::Lower,
        value: |d| Some(LEVELS * d.mae),
    },
    MetricInfo {
        name: "p99",
        unit: "levels",
        meaning: "error that 99 % of the covered pixels do not exceed",
        better: Better::Lower,
        value: |d| Some(LEVELS * d.p99),
    },
    MetricInfo {
        name: "over-half",
        unit: "%",
        meaning: "covered pixels that are off by more than half a grey level",
        better: Better::Lower,
        value: |d| Some(100.0 * d.share(d.over_half_level)),
    },
    MetricInfo {
        name: "over-one",
        unit: "%",
        meaning: "covered pixels that are off by more than one grey level",
        better: Better::Lower,
        value: |d| Some(100.0 * d.share(d.over_one_level)),
    },
    MetricInfo {
        name: "brightness",
        unit: "levels",
        meaning: "mean luminance against the reference: positive is too bright, negative too dark",
        better: Better::Zero,
        value: |d| Some(LEVELS * d.signed_mean),
    },
    MetricInfo {
        name: "psnr",
        unit: "dB",
        meaning: "peak signal-to-noise ratio of the whole frame, infinite for equal pictures",
        better: Better::Higher,
        value: |d| Some(d.psnr),
    },
    MetricInfo {
        name: "ssim",
        unit: "",
        meaning: "structural similarity of the whole frame (Wang et al. 2004), 1 for equal pictures",
        better: Better::Higher,
        value: |d| d.ssim,
    },
    MetricInfo {
        name: "flip",
        unit: "",
        meaning: "mean FLIP of the whole frame (Andersson et al. 2020), what a viewer sees: 0 for equal pictures, at most 1",
        better: Better::Lower,
        value: |d| d.flip,
    },
    MetricInfo {
        name: "differing",
        unit: "pixels",
        meaning: "pixels whose colour or alpha is not the same to the last bit",
        better: Better::Lower,
        value: |d| Some(d.differing as f64),
    },
    MetricInfo {
        name: "coverage",
        unit: "pixels",
        meaning: "pixels that only one of the pictures covers",
        better: Better::Lower,
        value: |d| Some(d.coverage_mismatches as f64),
    },
    MetricInfo {
        name: "not-finite",
        unit: "pixels",
        meaning: "pixels with an infinite channel or one that is not a number",
        better: Better::Lower,
        value: |d| Some(d.not_finite as f64),
    },
];
