#include "json_schema.hpp"

#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

namespace skelgen::test {

std::string schema_faults(const nlohmann::json& document, const std::filesystem::path& schema_file) {
    std::ifstream stream(schema_file);
    if (!stream) throw std::runtime_error("cannot read the schema " + schema_file.string());
    const nlohmann::json schema_document = nlohmann::json::parse(stream);

    valijson::Schema schema;
    valijson::SchemaParser parser;
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema_document), schema);
    valijson::Validator validator;
    valijson::ValidationResults results;
    validator.validate(schema, valijson::adapters::NlohmannJsonAdapter(document), &results);

    std::string faults;
    for (const valijson::ValidationResults::Error& error : results) {
        for (const std::string& step : error.context) faults += step;
        faults += ": " + error.description + "\n";
    }
    return faults;
}

} // namespace skelgen::test
