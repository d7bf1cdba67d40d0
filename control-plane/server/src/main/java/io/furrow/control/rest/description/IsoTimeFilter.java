package io.furrow.control.rest.description;

import java.io.IOException;

import com.fasterxml.jackson.databind.JsonNode;
import jakarta.annotation.Priority;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.core.MediaType;

import io.furrow.control.rest.access.VersionFilter;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Answers requests of {@code /api/v1} with times in ISO 8601. */
@Priority(Priorities.ENTITY_CODER) // after pages were cut
public final class IsoTimeFilter implements ContainerResponseFilter {
    private final ApiDescription description;

    public IsoTimeFilter(ApiDescription description) {
        this.description = description;
    }

    @Override
    public void filter(ContainerRequestContext request, ContainerResponseContext response) throws IOException {
        if (VersionFilter.isVersioned(request)
                && response.getEntity() instanceof byte[] json
                && MediaType.APPLICATION_JSON_TYPE.isCompatible(response.getMediaType())
                && description.operation(request).isPresent()) {
            response.setEntity(
                    withIsoTimes(json, description.operation(request).get().answer()));
        }
    }

    static byte[] withIsoTimes(byte[] json, MemberNames known) throws IOException {
        try {
            JsonNode read = NgsiJson.read(json);
            IsoTimes.write(read, known);
            return NgsiJson.write(read);
        } catch (UnreadableException e) {
            throw new IOException("an answer is not JSON", e);
        }
    }
}
