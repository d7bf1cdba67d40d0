package io.furrow.model.ngsi;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Base64;
import java.util.Set;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatCode;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/**
 * Runs JSONTestSuite (Nicolas Seriot, MIT) with all 318 documents of {@code test_parsing}: {@code y_} must be accepted,
 * {@code n_} must be rejected, and {@code parsing-decided.txt} lists the accepted ones of {@code i_}, which are
 * implementation-defined.
 */
public class JsonTestSuiteTest {
    private static final Path SUITE = Path.of("src/test/resources/json-test-suite");

    /** RFC 8259 says that names SHOULD be unique; here they MUST be, because either value may be meant. */
    private static final Set<String> ALSO_REJECTED =
            Set.of("y_object_duplicated_key", "y_object_duplicated_key_and_value");

    public record Case(String name, byte[] document) {
        @Override
        public String toString() {
            return name;
        }
    }

    @ParameterizedTest
    @MethodSource("rejected")
    void rejects(Case each) {
        assertThatThrownBy(() -> NgsiJson.read(each.document)).isInstanceOf(UnreadableException.class);
        assertThatThrownBy(() -> Notification.read(each.document, null)).isInstanceOf(UnreadableException.class);
    }

    @ParameterizedTest
    @MethodSource("accepted")
    void accepts(Case each) throws Exception {
        JsonNode read = NgsiJson.read(each.document);

        assertThat(NgsiJson.read(NgsiJson.write(read))).isEqualTo(read);
    }

    @ParameterizedTest
    @MethodSource("mustBeAccepted")
    void acceptsItAsTheValueOfAnAttribute(Case each) {
        String document = new String(each.document, UTF_8);
        byte[] body = ("{\"id\": \"a\", \"x\": {\"value\": " + document + "}}").getBytes(UTF_8);

        assertThatCode(() -> Entity.parse(
                        Notification.read(body, "normalized").entities().get(0).toBytes()))
                .doesNotThrowAnyException();
    }

    @Test
    void hasEveryDocument() throws Exception {
        assertThat(cases()).hasSize(318);
        assertThat(Stream.concat(rejected(), accepted())).hasSize(318);
    }

    static Stream<Case> accepted() throws Exception {
        Set<String> decided = Set.copyOf(Files.readAllLines(SUITE.resolve("parsing-decided.txt")));
        return cases().filter(each ->
                decided.contains(each.name) || each.name.startsWith("y_") && !ALSO_REJECTED.contains(each.name));
    }

    static Stream<Case> mustBeAccepted() throws Exception {
        return accepted().filter(each -> each.name.startsWith("y_"));
    }

    static Stream<Case> rejected() throws Exception {
        Set<String> accepted = accepted().map(Case::name).collect(java.util.stream.Collectors.toSet());
        return cases().filter(each -> !accepted.contains(each.name));
    }

    static Stream<Case> cases() throws IOException {
        return Files.readAllLines(SUITE.resolve("parsing.jsonl")).stream().map(JsonTestSuiteTest::read);
    }

    private static Case read(String line) {
        try {
            JsonNode json = NgsiJson.read(line.getBytes(UTF_8));
            String name = json.get("name").textValue();
            if (json.has("base64")) {
                return new Case(
                        name, Base64.getDecoder().decode(json.get("base64").textValue()));
            }
            String text = json.has("repeat")
                    ? json.get("repeat").textValue().repeat(json.get("times").intValue())
                    : json.get("text").textValue();
            return new Case(name, text.getBytes(UTF_8));
        } catch (UnreadableException e) {
            throw new IllegalArgumentException(line, e);
        }
    }
}
