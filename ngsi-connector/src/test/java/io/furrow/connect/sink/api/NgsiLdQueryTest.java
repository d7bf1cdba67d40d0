package io.furrow.connect.sink.api;

import java.util.Map;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.FiwareScope;

import static org.assertj.core.api.Assertions.assertThat;

class NgsiLdQueryTest {
    private static final FiwareScope SCOPE = new FiwareScope("farm", "/");

    private final NgsiLd api = new NgsiLd("");

    @Test
    void asksForNoMoreEntitiesThanThereMayBe() {
        assertThat(api.read(SCOPE, Map.of("urn:t:1", Set.of("Thermometer"), "urn:t:2", Set.of("Thermometer")))
                        .path())
                .contains("type=Thermometer&", "&limit=2&");
    }

    @Test
    void asksForEntitiesOfAnyTypeWhereThatOfOneIsNotKnown() {
        assertThat(api.read(SCOPE, Map.of("urn:t:1", Set.of("Thermometer"), "urn:r:1", Set.of("")))
                        .path())
                .contains("local=true&", "urn%3At%3A1", "urn%3Ar%3A1")
                .doesNotContain("type=");
    }
}
