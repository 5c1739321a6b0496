// The tables of reduce.toml, declared like those of a scene.
#pragma once

#include "cli/laboratory/lab_settings.hpp"

namespace pulvis::lab {

const schema::TableDeclaration<Settings>& declared_top();
const schema::TableDeclaration<PressSpec>& declared_press();
const schema::TableDeclaration<LoggerSpec>& declared_logger();
const schema::TableDeclaration<LoadCellSpec>& declared_load_cell();
const schema::TableDeclaration<LvdtSpec>& declared_lvdt();
const schema::TableDeclaration<CompactSpec>& declared_compact();
const schema::TableDeclaration<ClockSpec>& declared_clock();
const schema::TableDeclaration<AnalysisSpec>& declared_analysis();
const schema::TableDeclaration<SimulationSpec>& declared_simulation();
const schema::TableDeclaration<WedgeSpec>& declared_wedge();
const schema::TableDeclaration<RunSpec>& declared_run();
const schema::TableDeclaration<DieSpec>& declared_die();
const schema::TableDeclaration<CompressionSpec>& declared_compression();
const schema::TableDeclaration<CurveSpec>& declared_curve();
const schema::TableDeclaration<GaugesSpec>& declared_gauges();
const schema::TableDeclaration<TransmissionSpec>& declared_transmission();

}  // namespace pulvis::lab
