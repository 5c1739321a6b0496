// Short forms for the declarations of what three dimensions have to themselves.
#pragma once

#include "scenes/keys/declare.hpp"

namespace pulvis::space::language {

using schema::above;
using schema::Decoded;
using schema::Key;
using schema::Kind;
using schema::largest_size;
using schema::smallest_size;
using schema::TableDeclaration;
using schema::to;
using schema::value_for;
using schema::value_of;
using schema::within;
using schema::word_to;
using schema::Words;
using schema::words_of;
using schema::zero_vector;

}  // namespace pulvis::space::language
