// The two readers behind read_citygml, each over one document.
#pragma once

#include <string>

#include "tools/citygml/byte_source.h"
#include "tools/citygml/city_model.h"
#include "tools/citygml/member_splitter.h"

namespace nightcity {

/// Throws Error when the root element is none that holds city objects.
void require_citygml(const DocumentHead& head, const std::string& name);

/// The first srsName in the batch's members, as written; "" = none.
std::string first_srs_name(const MemberBatch& batch);

ReadReport read_with_libcitygml(const Document& document, const ReadOptions& options,
                                const ObjectSink& sink);
ReadReport read_with_stream(const Document& document, const ReadOptions& options,
                            const ObjectStage& stage);

/// A stage that does nothing but deliver.
ObjectStage deliver_to(const ObjectSink& sink);

}  // namespace nightcity
