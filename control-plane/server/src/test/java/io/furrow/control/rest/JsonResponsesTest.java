package io.furrow.control.rest;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;

import static org.assertj.core.api.Assertions.assertThat;

class JsonResponsesTest {
    @Test
    void locatesACreatedResourceExceptThatOfADryRun() {
        CommandResult created = CommandResult.of("created").with("domain", "north");

        assertThat(JsonResponses.created(created, "/api/domains", "domain").getLocation())
                .hasToString("/api/domains/north");
        assertThat(JsonResponses.created(created.ofDryRun(), "/api/domains", "domain")
                        .getLocation())
                .isNull();
    }
}
