package io.furrow.fields;

import java.nio.file.Path;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.field.FieldVersion;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;

/** Derives the id, name and domain of a field from the attributes of its feature. */
record FeatureNaming(ImportOptions options, Set<String> attributes) {
    private static final String ID = "id";
    private static final String NAME = "name";
    private static final String DOMAIN = "Domain";
    private static final String VALID_FROM = "validFrom";

    /** @throws InvalidFileException if an option names an attribute that no feature has */
    static FeatureNaming of(Path file, List<SourceFeature> features, ImportOptions options)
            throws InvalidFileException {
        Set<String> attributes = new TreeSet<>();
        features.forEach(feature -> feature.properties().fieldNames().forEachRemaining(attributes::add));
        require(file, "--id-property", options.idProperty(), attributes);
        require(file, "--name-property", options.nameProperty(), attributes);
        return new FeatureNaming(options, attributes);
    }

    private static void require(Path file, String option, String name, Set<String> attributes)
            throws InvalidFileException {
        if (name != null && attributes.stream().noneMatch(name::equalsIgnoreCase)) {
            throw new InvalidFileException("%s %s: no feature of %s has this attribute; there are %s"
                    .formatted(option, name, file, attributes));
        }
    }

    /** Returns the id as found, for messages; empty if there is none. */
    String called(SourceFeature feature) {
        if (options.idProperty() == null && feature.id() != null) {
            return feature.id();
        }
        return text(value(feature, options.idProperty() == null ? ID : options.idProperty()));
    }

    /** @throws RejectedFeatureException if there is no id, or one that the context broker would reject */
    String id(SourceFeature feature) throws RejectedFeatureException {
        String id = called(feature);
        if (id.isEmpty()) {
            throw new RejectedFeatureException(
                    "has no id; specify its attribute with --id-property, one of " + attributes);
        }
        if (!FieldVersion.isId(id)) {
            throw new RejectedFeatureException(
                    "has the id '%s', which is not a valid entity id; use at most 200 of A-Z a-z 0-9 _ - : ."
                            .formatted(Phrases.shortened(id)));
        }
        return id;
    }

    FieldVersion version(SourceFeature feature, ObjectNode geometry) throws RejectedFeatureException {
        ObjectNode properties = NgsiJson.object();
        put(properties, NAME, text(value(feature, options.nameProperty() == null ? NAME : options.nameProperty())));
        put(properties, DOMAIN, options.domain() == null ? text(value(feature, DOMAIN)) : options.domain());
        feature.properties().properties().forEach(one -> {
            if (!one.getKey().equals(VALID_FROM) && !properties.has(one.getKey())) {
                properties.set(one.getKey(), one.getValue());
            }
        });
        return new FieldVersion(id(feature), options.validFrom().toEpochMilli(), geometry, properties);
    }

    private static void put(ObjectNode properties, String name, String value) {
        if (!value.isEmpty()) {
            properties.put(name, value);
        }
    }

    /** Matches attribute names case-insensitively, because the case in Shapefiles varies. */
    private static JsonNode value(SourceFeature feature, String attribute) {
        if (feature.properties().has(attribute)) {
            return feature.properties().get(attribute);
        }
        return feature.properties().properties().stream()
                .filter(one -> one.getKey().equalsIgnoreCase(attribute))
                .map(one -> one.getValue())
                .findFirst()
                .orElse(MissingNode.getInstance());
    }

    /** Removes the fraction of zeros that tables add to integers. */
    private static String text(JsonNode value) {
        if (value.isNumber()) {
            return value.decimalValue().signum() == 0
                    ? "0"
                    : value.decimalValue().stripTrailingZeros().toPlainString();
        }
        return value.isTextual() ? value.textValue() : "";
    }
}
