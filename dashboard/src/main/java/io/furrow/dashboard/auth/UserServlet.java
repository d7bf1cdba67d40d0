package io.furrow.dashboard.auth;

import java.io.IOException;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.JsonNode;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;

/** Answers GET requests of users whom the control plane knows; a {@link Problem} becomes the response. */
public abstract class UserServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final transient UserCache users;
    private final transient Consumer<Problem> onRejection;

    /** @param onRejection is notified of each rejected request */
    protected UserServlet(UserCache users, Consumer<Problem> onRejection) {
        this.users = users;
        this.onRejection = onRejection;
    }

    @Override
    protected final void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            answer(request, response, users.find(Credentials.of(request)));
        } catch (Problem problem) {
            onRejection.accept(problem);
            problem.answer(response);
        }
    }

    /** @throws Problem to reject the request */
    protected abstract void answer(HttpServletRequest request, HttpServletResponse response, User user)
            throws IOException;

    protected static void write(JsonNode json, HttpServletResponse response) throws IOException {
        write(NgsiJson.write(json), response);
    }

    protected static void write(byte[] json, HttpServletResponse response) throws IOException {
        response.setContentType("application/json");
        response.setHeader("Cache-Control", "no-store");
        response.getOutputStream().write(json);
    }
}
