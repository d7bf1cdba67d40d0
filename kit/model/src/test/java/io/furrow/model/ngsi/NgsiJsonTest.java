package io.furrow.model.ngsi;

import java.time.Duration;
import java.util.HexFormat;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.catchThrowableOfType;
import static org.junit.jupiter.api.Assertions.assertTimeout;

@Timeout(60)
class NgsiJsonTest {
    @ParameterizedTest
    @CsvSource({
        "'', nothing", "20, only a space", "EFBBBF7B7D, a byte order mark",
        "FEFF007B007D, UTF-16", "0000007B0000007D, UTF-32", "22FF22, a byte that UTF-8 has not",
        "22C3, half a character", "22EDA08022, a surrogate as UTF-8", "7B7D7B7D, two documents",
        "7B7D78, trailing garbage", "7B22, an end too soon", "4E614E, NaN",
        "496E66696E697479, Infinity", "3031, a leading zero", "7B2761273A317D, single quotes",
        "7B2261223A312C2261223A317D, a name twice", "2209220A, a tab inside a text"
    })
    void rejectsInvalidJson(String hex, String what) {
        byte[] bytes = HexFormat.of().parseHex(hex);

        assertThat(unreadable(bytes).reason()).as(what).isEqualTo(Reason.NOT_JSON);
    }

    @Test
    void acceptsNestingUpToTheLimit() throws Exception {
        assertThat(NgsiJson.read(nested(NgsiJson.MAX_NESTING)).isArray()).isTrue();
        assertThat(unreadable(nested(NgsiJson.MAX_NESTING + 1)).reason()).isEqualTo(Reason.TOO_DEEP);
        assertThat(unreadable("[".repeat(100_000).getBytes(UTF_8)).reason()).isEqualTo(Reason.TOO_DEEP);
        assertThat(unreadable("{\"a\":".repeat(100_000).getBytes(UTF_8)).reason())
                .isEqualTo(Reason.TOO_DEEP);
    }

    @Test
    void acceptsTextsUpToEightMebibytes() throws Exception {
        String longest = "x".repeat(NgsiJson.MAX_STRING);

        assertThat(NgsiJson.read(quoted(longest)).textValue()).isEqualTo(longest);
        assertThat(unreadable(quoted(longest + "x")).reason()).isEqualTo(Reason.TOO_DEEP);
    }

    @ParameterizedTest
    @ValueSource(strings = {"1e9999999999", "1e-9999999999", "1e99999999999999999999", "LONG", "0.LONG"})
    void rejectsNumbersBeyondAllNumberTypes(String number) {
        byte[] json = number.replace("LONG", "9".repeat(1001)).getBytes(UTF_8);

        assertThat(unreadable(json).reason()).isEqualTo(Reason.TOO_DEEP);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {"1.50", "100000000000000000000000000000000001", "0.1", "-7", "21.50000000000000000000000001"})
    void writesNumbersDigitForDigit(String number) throws Exception {
        assertThat(NgsiJson.write(NgsiJson.read(number.getBytes(UTF_8))))
                .asString()
                .isEqualTo(number);
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "1e999999999", "-1e999999999", "1e-999999999",
                "1000e2147483647", "1e2147483647", "1e1001",
                "1e-1002"
            })
    void rejectsAnEntityWithANumberThatWouldFillTheMemory(String number) {
        String entity = "{\"id\":\"a\",\"x\":{\"value\":[{\"y\":" + number + "}]}}";

        assertTimeout(
                Duration.ofSeconds(5),
                () -> assertThatThrownBy(() -> Entity.parse(entity.getBytes(UTF_8)))
                        .isInstanceOfSatisfying(
                                UnreadableException.class,
                                e -> assertThat(e.reason()).isEqualTo(Reason.TOO_DEEP))
                        .hasMessageContaining("exponent"));
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "{\"id\":\"\\ud800\"}",
                "{\"id\":\"a\",\"x\\udc00\":{\"value\":1}}",
                "{\"id\":\"a\",\"x\":{\"value\":[\"\\udc00\\ud800\"]}}",
                "{\"id\":\"a\",\"type\":\"b\\ud83d\"}"
            })
    void rejectsAnEntityWithHalfACharacter(String entity) throws Exception {
        assertThatThrownBy(() -> Entity.parse(entity.getBytes(UTF_8)))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("surrogate");

        String pair = "{\"id\":\"\\ud83d\\ude9c\"}";
        assertThat(Entity.parse(pair.getBytes(UTF_8)).id()).isEqualTo("🚜");
    }

    /** The normalized form of a bare entity has one more level than its key-value form. */
    @Test
    void readsBackAllAcceptedKeyValues() throws Exception {
        Entity deepest = bare(NgsiJson.MAX_NESTING - 2);

        assertThat(Entity.parse(deepest.toBytes())).isEqualTo(deepest);
        assertThatThrownBy(() -> bare(NgsiJson.MAX_NESTING - 1))
                .isInstanceOf(UnreadableException.class)
                .hasMessageContaining("normalized form");
    }

    @Test
    void readsVeryManyAttributes() throws Exception {
        String body = IntStream.range(0, 50_000)
                .mapToObj(i -> "\"attribute" + i + "\":" + i)
                .collect(Collectors.joining(",", "{\"id\":\"a\",", "}"));

        Entity entity = assertTimeout(
                Duration.ofSeconds(15),
                () -> Notification.read(body.getBytes(UTF_8), null).entities().get(0));

        assertThat(entity.number("attribute49999")).contains(49_999.0);
    }

    private static Entity bare(int depthOfValue) throws UnreadableException {
        String value = new String(nested(depthOfValue), UTF_8);
        byte[] body = ("{\"id\":\"a\",\"x\":" + value + "}").getBytes(UTF_8);
        return Notification.read(body, "simplifiedKeyValues").entities().get(0);
    }

    private static byte[] nested(int depth) {
        return ("[".repeat(depth) + "]".repeat(depth)).getBytes(UTF_8);
    }

    private static byte[] quoted(String text) {
        return ("\"" + text + "\"").getBytes(UTF_8);
    }

    private static UnreadableException unreadable(byte[] bytes) {
        return catchThrowableOfType(UnreadableException.class, () -> NgsiJson.read(bytes));
    }
}
