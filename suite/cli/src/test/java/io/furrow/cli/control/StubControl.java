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
final class StubControl implements AutoCloseable {
    private record Answer(int status, String body) {}

    private final List<String> requested = new CopyOnWriteArrayList<>();
    private final Map<String, Deque<Answer>> answers = new ConcurrentHashMap<>();
    private final StringWriter output = new StringWriter();

    private final StubServer server = new StubServer(exchange -> {
        String request = exchange.getRequestMethod() + " " + exchange.getRequestURI();
        requested.add((request + " " + new String(exchange.getRequestBody().readAllBytes(), UTF_8)).trim());
        Deque<Answer> unversioned = answers.getOrDefault(request.replace("/api/v1/", "/api/"), new ArrayDeque<>());
        Deque<Answer> next = answers.getOrDefault(request, unversioned);
        Answer answer = next.size() > 1 ? next.poll() : next.peek();
        if (answer == null) {
            answer = new Answer(404, "{\"error\":\"unknown\",\"reason\":\"there is no %s\"}".formatted(request));
        }
        StubServer.answer(exchange, answer.status(), answer.body());
    });

    /** Sets the next answer to a request; the last one stays. @param request as {@code GET /api/missions} */
    StubControl answer(String request, int status, String body) {
        answers.computeIfAbsent(request, any -> new ArrayDeque<>()).add(new Answer(status, body.replace('\'', '"')));
        return this;
    }

    StubControl answer(String request, String body) {
        return answer(request, 200, body);
    }

    /** The requests so far, with their bodies. */
    List<String> requested() {
        return requested;
    }

    /** Returns what the commands printed since the last call. */
    String output() {
        String printed = output.toString();
        output.getBuffer().setLength(0);
        return printed;
    }

    String uri() {
        return server.uri("").toString();
    }

    int run(String... arguments) {
        CommandLine line = Commands.commandLine(CommandSpec.create().name("furrow"), Commands.ALL);
        return run(line, arguments);
    }

    int run(CommandLine line, String... arguments) {
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
