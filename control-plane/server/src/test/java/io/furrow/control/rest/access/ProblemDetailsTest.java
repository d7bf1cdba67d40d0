package io.furrow.control.rest.access;

import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class ProblemDetailsTest {
    @Test
    void hasTheMembersOfTheStandardAndOfTheManager() {
        CommandResult rejection = CommandResult.ofError("unknown-mission", "there is no mission 'm'")
                .with("mission", "m");

        assertThat(new String(ProblemDetails.of(404, rejection), UTF_8))
                .isEqualTo("{\"type\":\"about:blank\",\"title\":\"Not Found\",\"status\":404,"
                        + "\"detail\":\"there is no mission 'm'\",\"error\":\"unknown-mission\","
                        + "\"reason\":\"there is no mission 'm'\",\"mission\":\"m\"}");
        assertThat(rejection.status()).isEqualTo(CommandResult.ERROR);
    }
}
