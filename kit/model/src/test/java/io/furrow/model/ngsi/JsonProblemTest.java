package io.furrow.model.ngsi;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DeviceConnection;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class JsonProblemTest {
    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'temperature':2 | unexpected end of input at line 1, column 17
            {'temperature'   | unexpected end of input at line 1, column 15
            {'a':'b          | unexpected end of input at line 1, column 8
            [1,              | unexpected end of input at line 1, column 4
            {'a':1}{         | more than one JSON document at line 1, column 8
            {'a':1}¶{'a':2}  | more than one JSON document at line 2, column 1
            {'a':NaN}        | the token NaN is not a JSON number; send null instead at line 1, column 9
            [-Infinity]      | the token -Infinity is not a JSON number; send null instead at line 1, column 11
            [}               | unexpected close marker '}': expected ']' at line 1, column 2
            [/**/1]          | unexpected character ('/' (code 47)): maybe a (non-standard) comment? at line 1, column 2
            {'a':1,'a':2}    | duplicate field 'a' at line 1, column 11
            temperature=21   | unrecognized token 'temperature': was expecting (JSON String, Number, Array, Object or token 'null', 'true' or 'false') at line 1, column 1
            """)
    void describesWhereTheInputEndsOrIsInvalid(String json, String words) {
        assertThatThrownBy(() -> NgsiJson.read(bytes(json.replace('¶', '\n')))).hasMessage(words);
    }

    /** Input that a lenient reader would accept. */
    @ParameterizedTest
    @ValueSource(
            strings = {
                "[+1]", "[.5]", "[1.]", "[01]", "[+Infinity]", "[-INF]", "[nan]", "[0x1F]", "{a:1}", "{\\'a\\':1}",
                        "[1,]", "[,1]", "{'a':1,}",
                "#x", "//x", "['\t']", "['\\x']", "['\\u12']", "[1}", "{'a' 1}", "{1:2}", "[1e]", "tru", "]", "'",
                        "[9999999999e9999999999]"
            })
    void containsNoWordsOfALibrary(String json) {
        assertThatThrownBy(() -> NgsiJson.read(bytes(json)))
                .hasMessageNotContainingAny("Feature", "fasterxml", "`", "Source", "Exception")
                .message()
                .doesNotContainPattern("[A-Z]+_[A-Z]+");
    }

    @Test
    void acceptsAByteOrderMarkInFilesOnly() throws Exception {
        assertThatThrownBy(() -> NgsiJson.read(bytes("\ufeff{'a':1}")))
                .hasMessage("the text begins with a byte order mark (EF BB BF); send it without");
        assertThat(NgsiJson.readFile(bytes("\ufeff{'a':1}"))).hasToString("{\"a\":1}");
    }

    @Test
    void namesNoConstantOfALimit() {
        assertThatThrownBy(() -> NgsiJson.read(bytes("[".repeat(2000))))
                .hasMessageMatching("document nesting depth \\(\\d+\\) exceeds the maximum allowed \\(\\d+\\)");
    }

    @Test
    void namesTheMemberOfAnotherTypeInsteadOfAClass() {
        assertThatThrownBy(() -> DeviceConnection.read(bytes("{'refusedLogin':{'count':[]}}")))
                .hasMessage(
                        "not a record of a device's connection: member 'refusedLogin.count' is not what it must be at line 1, column 26");
        assertThatThrownBy(() -> DeviceConnection.read(bytes("[]")))
                .hasMessage(
                        "not a record of a device's connection: the value is not what it must be at line 1, column 1");
    }

    private static byte[] bytes(String json) {
        return json.replace('\'', '"').getBytes(UTF_8);
    }
}
