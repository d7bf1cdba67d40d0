package io.furrow.soak.source;

import java.io.IOException;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;

/** A change of an entity: the value of its attribute {@code Number}, which is incremented by each change. */
record NumberedChange(int entity, int number) {
    static final String TYPE = "Thermometer";

    private static final String PREFIX = "urn:ngsi-ld:Thermometer:";

    static NumberedChange read(byte[] json) throws IOException {
        return of(NgsiJson.mapper().readTree(json));
    }

    static NumberedChange of(JsonNode entity) {
        return new NumberedChange(
                Integer.parseInt(entity.path("id").asText().substring(PREFIX.length())),
                entity.at("/Number/value").asInt(-1));
    }

    String id() {
        return PREFIX + entity;
    }
}
