package io.furrow.dashboard.http;

import java.io.IOException;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.model.ngsi.NgsiJson;

/** Why a request is refused, in the shape that the control plane's REST API uses: {@code status}, {@code error}, {@code reason}. */
public final class Problem extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final int status;
    private final String error;

    /**
     * @param status of HTTP
     * @param error a code
     * @param reason a sentence
     */
    public Problem(int status, String error, String reason) {
        super(reason, null, false, false);
        this.status = status;
        this.error = error;
    }

    /** A code. */
    public String error() {
        return error;
    }

    public int status() {
        return status;
    }

    public byte[] json() {
        return json(error, getMessage());
    }

    public static byte[] json(String error, String reason) {
        return NgsiJson.write(JsonNodeFactory.instance
                .objectNode()
                .put("type", "response")
                .put("status", "error")
                .put("error", error)
                .put("reason", reason));
    }

    public void answer(HttpServletResponse response) throws IOException {
        response.setStatus(status);
        if (status == HttpServletResponse.SC_UNAUTHORIZED) {
            response.setHeader("WWW-Authenticate", "Bearer");
        }
        response.setContentType("application/json");
        response.getOutputStream().write(json());
    }
}
