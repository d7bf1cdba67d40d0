package io.furrow.model.control;

import java.util.Random;
import java.util.function.Function;

import org.junit.jupiter.api.Test;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class RequestsPropertyTest {
    private static final int CASES = 3000;
    private static final String[] SPLICES = {
        "null", "{}", "[]", "1e999", "-1", "1000e2147483647",
        "\"\\ud800\"", "\"\"", "[[[[]]]]", "true", "\"a.b\"", "999999999999999999",
        "\"+999999999-12-31T23:59:59Z\"", "\"PT9999999999999999H\"", "{\"type\":\"Polygon\"}"
    };

    @Test
    void readsBackEveryCommand() {
        long seed = System.nanoTime();
        MadeUpCommands made = new MadeUpCommands(new Random(seed));
        for (int i = 0; i < CASES; i++) {
            String id = i % 2 == 0 ? "r-" + i : null;
            DomainCommand domain = made.domain();
            MissionCommand mission = made.mission();
            ReplayCommand replay = made.replay();

            assertThat(Requests.domain(Requests.write(id, domain)))
                    .as("seed %d", seed)
                    .isEqualTo(new ParsedRequest.Request<>(id, domain));
            assertThat(Requests.mission(Requests.write(id, mission)))
                    .as("seed %d", seed)
                    .isEqualTo(new ParsedRequest.Request<>(id, mission));
            assertThat(Requests.replay(Requests.write(id, replay)))
                    .as("seed %d", seed)
                    .isEqualTo(new ParsedRequest.Request<>(id, replay));
        }
    }

    @Test
    void answersBrokenRequestsWithACodeAndASentence() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        MadeUpCommands made = new MadeUpCommands(random);
        int rejected = 0;
        for (int i = 0; i < CASES; i++) {
            rejected += refusals(broken(Requests.write("r", made.domain()), random), Requests::domain, seed);
            rejected += refusals(broken(Requests.write("r", made.mission()), random), Requests::mission, seed);
            rejected += refusals(broken(Requests.write("r", made.replay()), random), Requests::replay, seed);
        }
        assertThat(rejected).isGreaterThan(CASES);
    }

    /** Checks that a valid request can be written and read again, and that an invalid one has a readable answer. */
    private static <C extends Command> int refusals(
            byte[] request, Function<byte[], ParsedRequest<C>> reader, long seed) throws Exception {
        ParsedRequest<C> parsedRequest = reader.apply(request);
        String description = "seed %d: %s".formatted(seed, new String(request, UTF_8));
        if (parsedRequest instanceof ParsedRequest.Request<C> understood) {
            assertThat(reader.apply(Requests.write(understood.requestId(), understood.command())))
                    .as(description)
                    .isEqualTo(parsedRequest);
        } else if (parsedRequest instanceof ParsedRequest.Refused<C> rejected) {
            var answer = CommandResult.read(
                    rejected.answer().to(rejected.requestId()).toBytes());
            assertThat(answer.status()).as(description).isEqualTo("error");
            assertThat(answer.error()).as(description).isPresent();
            assertThat(answer.json().path("reason").asText()).as(description).isNotBlank();
            return 1;
        }
        return 0;
    }

    private static byte[] broken(byte[] request, Random random) {
        String text = new String(request, UTF_8);
        int at = random.nextInt(text.length());
        int colon = text.indexOf(':', at);
        text = switch (random.nextInt(4)) {
            case 0 -> text.substring(0, at);
            case 1 -> text.substring(0, at) + (char) random.nextInt(128) + text.substring(at + 1);
            default -> colon < 0 ? text + "]" : spliced(text, colon + 1, SPLICES[random.nextInt(SPLICES.length)]);
        };
        return text.getBytes(UTF_8);
    }

    /** Replaces a scalar value. */
    private static String spliced(String text, int from, String value) {
        int end = from;
        while (end < text.length() && ",}]".indexOf(text.charAt(end)) < 0) {
            end++;
        }
        return text.substring(0, from) + value + text.substring(end);
    }
}
