package io.furrow.dashboard.http;

import java.io.IOException;
import java.nio.ByteBuffer;

import jakarta.servlet.http.HttpServletResponse;
import org.eclipse.jetty.http.HttpHeader;
import org.eclipse.jetty.server.Response;
import org.eclipse.jetty.util.Callback;

import io.furrow.model.control.CommandResult;

/** Rejects a request, in the format of the control plane's REST API: {@code status}, {@code error}, {@code reason}. */
public final class Problem extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final int status;
    private final String error;

    /**
     * @param status HTTP status
     * @param error code
     * @param reason sentence for the user
     */
    public Problem(int status, String error, String reason) {
        super(reason, null, false, false);
        this.status = status;
        this.error = error;
    }

    /** The code. */
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
        return CommandResult.ofError(error, reason).toBytes();
    }

    /** Rejects a request whose thread was interrupted; the interrupt flag stays set. */
    public static Problem stopping() {
        Thread.currentThread().interrupt();
        return new Problem(503, "stopping", "the dashboard is stopping");
    }

    public void answer(Response response, Callback callback) {
        response.setStatus(status);
        response.getHeaders().put(HttpHeader.CONTENT_TYPE, "application/json");
        response.write(true, ByteBuffer.wrap(json()), callback);
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
