package io.furrow.model.control;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * Compares the answers of managers to the byte: each file of {@code golden/request} has requests, each followed by the
 * same request as Furrow writes it, or by its rejection. Rewritten with {@code -Dgolden.renew=true}.
 */
class GoldenRequestsTest {
    private static final Path FOLDER = Path.of("src/test/resources/golden/request");

    @ParameterizedTest
    @ValueSource(strings = {"domain", "mission", "replay", "alarm"})
    void answersAsInTheGoldenFile(String manager) throws IOException {
        Path file = FOLDER.resolve(manager + ".txt");
        List<String> golden = Files.readAllLines(file);
        List<String> now = new ArrayList<>();
        for (String line : golden) {
            if (!line.startsWith(" ") && !line.isEmpty()) {
                now.addAll(List.of(line, "  " + answer(manager, expand(line)), ""));
            }
        }
        if (Boolean.getBoolean("golden.renew")) {
            Files.write(file, now);
        }
        assertThat(now).hasSizeGreaterThan(20).isEqualTo(Files.readAllLines(file));
    }

    private static byte[] expand(String line) {
        String json = line.startsWith("{'type'") || !line.startsWith("{") || line.equals("{}")
                ? line
                : line.replaceFirst("\\{", "{'type':'request',");
        return json.replace('\'', '"').getBytes(UTF_8);
    }

    private static String answer(String manager, byte[] request) {
        ParsedRequest<? extends Command> parsed = switch (manager) {
            case "domain" -> Requests.domain(request);
            case "mission" -> Requests.mission(request);
            case "replay" -> Requests.replay(request);
            default -> Requests.alarm(request);
        };
        if (parsed instanceof ParsedRequest.Request<? extends Command> understood) {
            byte[] refusal = Requests.refusal(
                            new RejectedException(ErrorCode.OVERLOADED, "later"), understood.command())
                    .toBytes();
            return text(Requests.write(understood.requestId(), understood.command())) + text(refusal);
        }
        return text(((ParsedRequest.Refused<? extends Command>) parsed).answer().toBytes());
    }

    private static String text(byte[] json) {
        return new String(json, UTF_8);
    }
}
