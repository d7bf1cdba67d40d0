package io.furrow.cli.control;

import java.io.PrintWriter;
import java.io.StringWriter;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;

import picocli.CommandLine;
import picocli.CommandLine.Model.CommandSpec;

import io.furrow.cli.Commands;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Runs commands against a control plane that answers as it is told, and refuses all else with 404. */
public final class StubControl implements AutoCloseable {
    private record Answer(int status, String body, String link) {}

    private final List<String> requested = new CopyOnWriteArrayList<>();
    private final Map<String, Deque<Answer>> answers = new ConcurrentHashMap<>();
    private final StringWriter output = new StringWriter();

    private final StubServer server = new StubServer(exchange -> {
        String whole = exchange.getRequestMethod() + " " + exchange.getRequestURI();
        String request = whole.replaceFirst("[?&]limit=1000$", ""); // as all lists have it
        requested.add((whole + " " + new String(exchange.getRequestBody().readAllBytes(), UTF_8)).trim());
        Deque<Answer> unversioned = answers.getOrDefault(request.replace("/api/v1/", "/api/"), new ArrayDeque<>());
        Deque<Answer> next = answers.getOrDefault(request, unversioned);
        Answer answer = next.size() > 1 ? next.poll() : next.peek();
        if (answer == null) {
            answer = new Answer(404, "{\"error\":\"unknown\",\"reason\":\"there is no %s\"}".formatted(request), null);
        } else if (answer.link() != null) {
            exchange.getResponseHeaders().add("Link", "<%s>; rel=\"next\"".formatted(answer.link()));
        }
        StubServer.answer(exchange, answer.status(), answer.body());
    });

    /** Sets the next answer to a request; the last one stays. @param request as {@code GET /api/missions} */
    public StubControl answer(String request, int status, String body) {
        return add(request, new Answer(status, body.replace('\'', '"'), null));
    }

    /** Sets an answer with a next page. @param next its query */
    public StubControl answerPage(String request, String body, String next) {
        return add(request, new Answer(200, body.replace('\'', '"'), next));
    }

    private StubControl add(String request, Answer answer) {
        answers.computeIfAbsent(request, any -> new ArrayDeque<>()).add(answer);
        return this;
    }

    public StubControl answer(String request, String body) {
        return answer(request, 200, body);
    }

    /** The requests so far, with their bodies. */
    public List<String> requested() {
        return requested;
    }

    /** Returns what the commands printed since the last call. */
    public String output() {
        String printed = output.toString();
        output.getBuffer().setLength(0);
        return printed;
    }

    public String uri() {
        return server.uri("").toString();
    }

    public int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        return run(line, arguments);
    }

    public int run(CommandLine line, String... arguments) {
        line.setOut(new PrintWriter(output, true)).setErr(new PrintWriter(output, true));
        List<String> all = new ArrayList<>(List.of(arguments));
        all.add("--api=" + uri());
        return line.execute(all.toArray(String[]::new));
    }

    @Override
    public void close() {
        server.close();
    }
}
