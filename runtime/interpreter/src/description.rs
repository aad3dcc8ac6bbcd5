//! Converts the compiler's description of a mechanism to the runtime's types.

use eigentol::{
    CoordinateInfo, CorrelationInfo, DampingKind, Description, DesignInfo, ExcitationInfo, InputInfo, KernelInfo, Law,
    LineKind, OutputInfo, RingInfo, Role, SpanInfo, Text, ToleranceInfo, Unit,
};
use eigentol_compiler::Compilation;
use eigentol_compiler::base::names::written;
use eigentol_compiler::mechanics;
use eigentol_compiler::model::mechanism;

pub(crate) fn text(text: impl Into<String>) -> Text {
    Text::from(written(&text.into()).into_owned())
}

fn unit(unit: &mechanism::Unit) -> Unit {
    Unit { symbol: text(unit.symbol.as_str()), scale: unit.scale }
}

pub(crate) fn tolerance(tolerance: &mechanism::Tolerance) -> ToleranceInfo {
    if !tolerance.varies() {
        return ToleranceInfo::NONE;
    }
    ToleranceInfo {
        lower: tolerance.lower,
        upper: tolerance.upper,
        relative: tolerance.relative,
        law: match &tolerance.law {
            mechanism::Law::Normal => Law::Normal,
            mechanism::Law::TruncatedNormal => Law::TruncatedNormal,
            mechanism::Law::Uniform => Law::Uniform,
            mechanism::Law::Triangular => Law::Triangular,
            mechanism::Law::Lognormal => Law::Lognormal,
            mechanism::Law::Weibull => Law::Weibull,
            mechanism::Law::Beta { alpha, beta } => Law::Beta { alpha: *alpha, beta: *beta },
            mechanism::Law::OneOf(values) => Law::OneOf(values.clone().into()),
        },
    }
}

fn correlation(of: &mechanism::Correlation) -> CorrelationInfo {
    CorrelationInfo { variables: of.variables.map(|id| id.index()), correlation: of.correlation }
}

fn span(of: &mechanics::SpanPlaces) -> SpanInfo {
    SpanInfo {
        line: match of.line {
            mechanism::Line::Timoshenko => LineKind::Timoshenko,
            mechanism::Line::Slender => LineKind::Slender,
            mechanism::Line::Bar => LineKind::Bar,
        },
        elements: of.elements.clone().into(),
        ends: of.ends.clone().map(Into::into),
    }
}

fn ring(of: &mechanics::RingPlaces) -> RingInfo {
    RingInfo {
        name: text(of.name.as_str()),
        members: of.members,
        coordinates: of.coordinates.clone().into(),
        patterns: of.patterns,
        design: of.design.clone().into(),
    }
}

/// Names, units, nominal values and properties of a compiled declaration, for those who need no kernels.
pub fn description(compilation: &Compilation) -> Description {
    let Compilation { mechanism, functions, program, .. } = compilation;
    let coordinates: Vec<_> = functions
        .unknowns
        .iter()
        .map(|unknown| CoordinateInfo {
            name: text(unknown.name.as_str()),
            unit: Unit { symbol: text(unknown.unit.as_str()), scale: 1.0 },
            role: match unknown.role {
                mechanics::Role::Position(_) | mechanics::Role::Harmonic(_) => Role::Position,
                mechanics::Role::Speed(_) => Role::Speed,
                mechanics::Role::PositionReaction => Role::PositionReaction,
                mechanics::Role::VelocityReaction => Role::VelocityReaction,
            },
        })
        .collect();
    let inputs: Vec<_> = mechanism
        .inputs
        .iter()
        .map(|input| InputInfo {
            name: text(input.name.to_string()),
            unit: unit(&input.unit),
            tolerance: tolerance(&input.tolerance),
        })
        .collect();
    let design: Vec<_> = mechanism
        .design
        .iter()
        .map(|variable| DesignInfo {
            name: text(variable.name.to_string()),
            unit: unit(&variable.unit),
            nominal: variable.nominal,
            tolerance: tolerance(&variable.tolerance),
        })
        .collect();
    let outputs: Vec<_> = mechanism
        .outputs
        .iter()
        .map(|output| OutputInfo { name: text(output.name.to_string()), unit: unit(&output.unit) })
        .collect();
    let excitations: Vec<_> = functions
        .excitations
        .iter()
        .map(|excitation| ExcitationInfo {
            name: text(excitation.name.as_str()),
            kind: text(excitation.kind),
            with: excitation.with,
            order: text(excitation.order.as_str()),
        })
        .collect();
    let kernels: Vec<_> = program
        .kernels
        .iter()
        .map(|kernel| KernelInfo {
            name: text(kernel.name),
            operations: kernel.cost.operations,
            functions: kernel.cost.functions,
        })
        .collect();
    Description {
        name: text(mechanism.name.to_string()),
        coordinates: coordinates.into(),
        inputs: inputs.into(),
        design: design.into(),
        outputs: outputs.into(),
        excitations: excitations.into(),
        symmetric_stiffness: functions.properties.symmetric_stiffness,
        free_directions: functions.free.count,
        correlations: mechanism.correlations.iter().map(correlation).collect::<Vec<_>>().into(),
        held: functions.held.clone().into(),
        rings: functions.rings.iter().map(ring).collect::<Vec<_>>().into(),
        spans: functions.spans.iter().map(span).collect::<Vec<_>>().into(),
        harmonics: functions.harmonics.clone().into(),
        length: mechanism.length,
        frequency: unit(&mechanism.frequency_unit()),
        resolved_modes: mechanics::resolved_modes(mechanism, functions),
        damping: match functions.properties.damping {
            mechanics::Damping::Zero => DampingKind::Zero,
            mechanics::Damping::Gyroscopic => DampingKind::Gyroscopic,
            mechanics::Damping::General => DampingKind::General,
        },
        kernels: kernels.into(),
    }
}
