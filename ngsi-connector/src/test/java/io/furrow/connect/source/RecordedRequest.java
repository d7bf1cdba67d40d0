package io.furrow.connect.source;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.http.HttpRequest;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;

import static java.nio.charset.StandardCharsets.UTF_8;

/** A notification of a real Orion as it went over the wire. */
record RecordedRequest(String path, List<String[]> headers, String body) {
    private static final List<String> SET_BY_THE_CLIENT = List.of("host", "content-length");

    static RecordedRequest of(String name) {
        try {
            String text = Files.readString(Path.of("src/test/resources/notifications", name + ".http"));
            String[] headAndBody = text.split("\r?\n\r?\n", 2);
            String[] head = headAndBody[0].split("\r?\n");
            List<String[]> headers =
                    Arrays.stream(head).skip(1).map(line -> line.split(": ", 2)).toList();
            return new RecordedRequest(head[0].split(" ")[1], headers, headAndBody[1].strip());
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The request to a server, its times set back a year: a clock that is right today is never behind them. */
    HttpRequest to(URI server) {
        HttpRequest.Builder request = HttpRequest.newBuilder(server.resolve(path))
                .POST(HttpRequest.BodyPublishers.ofString(body.replace("\"2026-", "\"2025-"), UTF_8));
        headers.stream()
                .filter(header -> !SET_BY_THE_CLIENT.contains(header[0].toLowerCase(java.util.Locale.ROOT)))
                .forEach(header -> request.header(header[0], header[1]));
        return request.build();
    }
}
