// The tables of a scene, which together form the scene language.
#pragma once

#include "scenes/language/document.hpp"
#include "scenes/language/schema.hpp"
#include "scenes/spec/afm_scene.hpp"
#include "scenes/spec/die.hpp"
#include "scenes/spec/scene.hpp"

namespace pulvis::schema {

const TableDeclaration<Scene>& top_level();
const TableDeclaration<MaterialSpec>& material();
const TableDeclaration<MaterialSpec>& material_damping();
const TableDeclaration<FlowLaw>& hardening();
const TableDeclaration<FlowLaw>& rate();
const TableDeclaration<ParticleSpec>& particle();
const TableDeclaration<ParticleSpec>& mesh();
const TableDeclaration<GrainsSpec>& grains();
const TableDeclaration<BodySpec>& body();
const TableDeclaration<PackingSpec>& packing();
const TableDeclaration<MixtureClass>& mixture_class();
const TableDeclaration<DieSpec>& die();
const TableDeclaration<CellSpec>& cell();
const TableDeclaration<CellDriveSpec>& cell_drive();
const TableDeclaration<ToolSpec>& tool();
const TableDeclaration<StageSpec>& stage();
const TableDeclaration<MoveSpec>& move();
const TableDeclaration<ServoSpec>& servo();
const TableDeclaration<UntilSpec>& until();
const TableDeclaration<FrictionSpec>& friction();
const TableDeclaration<BondSpec>& bond();
const TableDeclaration<ContactSpec>& contact();
const TableDeclaration<ElementSpec>& element();
const TableDeclaration<TimeSpec>& time();
const TableDeclaration<OutputSpec>& output();
const TableDeclaration<LimitSpec>& limits();
const TableDeclaration<ExpectSpec>& expect();
const TableDeclaration<LeverSpec>& lever();
const TableDeclaration<TipSpec>& tip();
const TableDeclaration<LaserSpec>& laser();
const TableDeclaration<DetectorSpec>& detector();
const TableDeclaration<TargetSpec>& surface();
const TableDeclaration<ActionSpec>& action();

// Of all scenes: keys say in which dimensions they exist.
const Language& scene_language();
// Of scenes with this dimension, 2 or 3.
const Language& scene_language(int dimension);

}  // namespace pulvis::schema

namespace pulvis {

// 2, or 3 if the scene says `dimension = 3`.
int dimension_of(const document::Table& root);
// For a scene: depends on its dimension.
const schema::Language& language_of(const document::Table& root);

}  // namespace pulvis

namespace pulvis::space::language {

const schema::TableDeclaration<ParticleSpec>& particle();
const schema::TableDeclaration<ParticleSpec>& mesh();

}  // namespace pulvis::space::language
