package io.furrow.control.rest;

import java.net.URI;

import org.glassfish.jersey.internal.MapPropertiesDelegate;
import org.glassfish.jersey.server.ContainerRequest;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;

import static org.assertj.core.api.Assertions.assertThat;

class JsonResponsesTest {
    private static final CommandResult CREATED = CommandResult.of("created").with("domain", "north");

    @Test
    void locatesACreatedResourceExceptThatOfADryRun() {
        assertThat(location("api/domains", CREATED)).isEqualTo(URI.create("http://farm/api/domains/north"));
        assertThat(location("api/domains/", CREATED)).isEqualTo(URI.create("http://farm/api/domains/north"));
        assertThat(location("api/domains", CREATED.ofDryRun())).isNull();
    }

    /** As a client resolves it. */
    private static URI location(String path, CommandResult answer) {
        URI base = URI.create("http://farm/");
        ContainerRequest request =
                new ContainerRequest(base, base.resolve(path), "POST", null, new MapPropertiesDelegate(), null);
        URI location =
                JsonResponses.created(request, answer, "domains", "domain").getLocation();
        return location == null ? null : request.getRequestUri().resolve(location);
    }
}
