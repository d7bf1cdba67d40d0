package io.furrow.http;

import java.util.Map;

/** What becomes of a request. */
public sealed interface Decision {
    /** The status of every refusal. */
    int REFUSED_STATUS = 403;

    /**
     * Answer {@value #REFUSED_STATUS}, read no body and keep no connection.
     *
     * @param error a code: {@code foreign-host} or {@code foreign-origin}
     * @param reason a sentence that says what to set
     */
    record Refused(String error, String reason) implements Decision {}

    /** Answer 204 with these headers. */
    record Preflight(Map<String, String> headers) implements Decision {}

    /** Continue, and add these headers to the answer. */
    record Granted(Map<String, String> headers) implements Decision {}
}
