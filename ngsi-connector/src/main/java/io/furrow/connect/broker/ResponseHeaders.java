package io.furrow.connect.broker;

import java.net.http.HttpHeaders;
import java.util.Optional;
import java.util.OptionalLong;

/** The headers of an answer; names are case-insensitive. */
public record ResponseHeaders(HttpHeaders headers) {
    public Optional<String> first(String name) {
        return headers.firstValue(name);
    }

    /** {@code Fiware-Total-Count}: the total number of results, beyond the page. */
    public OptionalLong totalCount() {
        try {
            return headers.firstValueAsLong("Fiware-Total-Count");
        } catch (NumberFormatException e) {
            return OptionalLong.empty();
        }
    }

    /** The last segment of {@code Location}: the id of the created resource. */
    public Optional<String> createdId() {
        return first("Location").map(location -> location.substring(location.lastIndexOf('/') + 1));
    }
}
