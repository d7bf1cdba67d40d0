package io.furrow.http;

import java.util.Map;

/** The decision on a request. */
public sealed interface Decision {
    /** The status of every rejection. */
    int REFUSED_STATUS = 403;

    /**
     * Answers {@value #REFUSED_STATUS}, reads no body and closes the connection.
     *
     * @param error a code: {@code foreign-host} or {@code foreign-origin}
     * @param reason a sentence that names the option to set
     */
    record Refused(String error, String reason) implements Decision {}

    /** Answers 204 with these headers. */
    record Preflight(Map<String, String> headers) implements Decision {}

    /** Continues, and adds these headers to the answer. */
    record Granted(Map<String, String> headers) implements Decision {}
}
