// The tables of a scene in three dimensions, and the language they form. Whatever is the same in two dimensions is
// declared there (scenes/keys/tables.hpp).
#pragma once

#include "scenes/keys/tables.hpp"
#include "scenes/language/document.hpp"
#include "scenes/spec/space_scene.hpp"

namespace pulvis::space {

namespace language {

const schema::TableDeclaration<Scene>& top_level();
const schema::TableDeclaration<ParticleSpec>& particle();
const schema::TableDeclaration<ParticleSpec>& mesh();
const schema::TableDeclaration<BodySpec>& body();
const schema::TableDeclaration<PackingSpec>& packing();
const schema::TableDeclaration<MixtureClass>& mixture_class();
const schema::TableDeclaration<ToolSpec>& tool();
const schema::TableDeclaration<StageSpec>& stage();
const schema::TableDeclaration<MoveSpec>& move();
const schema::TableDeclaration<ServoSpec>& servo();
const schema::TableDeclaration<UntilSpec>& until();
const schema::TableDeclaration<BondSpec>& bond();
const schema::TableDeclaration<ContactSpec>& contact();
const schema::TableDeclaration<SpaceScene>& element();
const schema::TableDeclaration<TimeSpec>& time();
const schema::TableDeclaration<OutputSpec>& output();
const schema::TableDeclaration<ExpectSpec>& expect();

}  // namespace language

const schema::Language& scene_language();

}  // namespace pulvis::space

namespace pulvis {

// Whether the scene says `dimension = 3`.
bool is_in_space(const document::Table& root);
// For a scene: depends on its `dimension`.
const schema::Language& language_of(const document::Table& root);

}  // namespace pulvis
