package io.furrow.model.ngsi;

import java.nio.charset.StandardCharsets;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.device.DeviceConnection;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JsonProblemTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'temperature':2 | unexpected end of input at line 1, column 17
            {'temperature'   | unexpected end of input at line 1, column 15
            {'a':'b          | unexpected end of input at line 1, column 8
            [1,              | unexpected end of input at line 1, column 4
            {'a':1}{         | more follows after the end of the value at line 1, column 8
            {'a':NaN}        | non-standard token 'NaN' at line 1, column 9
            {'a':1,'a':2}    | duplicate field 'a' at line 1, column 11
            temperature=21   | unrecognized token 'temperature': was expecting (JSON String, Number, Array, Object or token 'null', 'true' or 'false') at line 1, column 1
            """)
    void saysWhereItEndsOrIsBroken(String json, String words) {
        assertThatThrownBy(() -> NgsiJson.read(bytes(json))).hasMessage(words);
    }

    @Test
    void namesNoConstantOfALimit() {
        assertThatThrownBy(() -> NgsiJson.read(bytes("[".repeat(2000))))
                .hasMessageMatching("document nesting depth \\(\\d+\\) exceeds the maximum allowed \\(\\d+\\)");
    }

    @Test
    void namesTheMemberThatIsOfAnotherTypeRatherThanAClass() {
        assertThatThrownBy(() -> DeviceConnection.read(bytes("{'refusedLogin':{'count':[]}}")))
                .hasMessage(
                        "no record of a device's connection: member 'refusedLogin.count' is not what it must be at line 1, column 26");
        assertThatThrownBy(() -> DeviceConnection.read(bytes("[]")))
                .hasMessage("no record of a device's connection: the value is not what it must be at line 1, column 1");
    }

    private static byte[] bytes(String json) {
        return json.replace('\'', '"').getBytes(StandardCharsets.UTF_8);
    }
}
