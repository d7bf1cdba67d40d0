package io.furrow.dashboard.auth;

import java.io.IOException;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.JsonNode;
import jakarta.servlet.http.HttpServlet;
import jakarta.servlet.http.HttpServletRequest;
import jakarta.servlet.http.HttpServletResponse;

import io.furrow.dashboard.http.Problem;
import io.furrow.model.ngsi.NgsiJson;

/** Answers GET requests of users whom the control plane knows; a {@link Problem} is the answer, too. */
public abstract class UserServlet extends HttpServlet {
    private static final long serialVersionUID = 1L;

    private final transient UserCache users;
    private final transient Consumer<Problem> refused;

    /** @param refused is notified of each request that is refused */
    protected UserServlet(UserCache users, Consumer<Problem> refused) {
        this.users = users;
        this.refused = refused;
    }

    @Override
    protected final void doGet(HttpServletRequest request, HttpServletResponse response) throws IOException {
        try {
            answer(request, response, users.find(Credentials.of(request)));
        } catch (Problem problem) {
            refused.accept(problem);
            problem.answer(response);
        }
    }

    /** @throws Problem where it is refused */
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
