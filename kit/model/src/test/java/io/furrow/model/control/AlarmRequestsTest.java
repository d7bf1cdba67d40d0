package io.furrow.model.control;

import java.nio.charset.StandardCharsets;
import java.time.Duration;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class AlarmRequestsTest {
    @Test
    void readsWhatItWrites() {
        for (AlarmCommand command : new AlarmCommand[] {
            new AlarmCommand.Acknowledge("collision-1", "ann"),
            new AlarmCommand.Close("collision-1", null),
            new AlarmCommand.Mute(new AlarmCommand.OfAlarm("collision-1"), Duration.ofHours(1)),
            new AlarmCommand.Mute(new AlarmCommand.OfKind(AlarmKind.SILENT_DEVICE, "urn:x"), Duration.ofDays(1)),
            new AlarmCommand.Unmute(new AlarmCommand.OfKind(AlarmKind.COLLISION, null))
        }) {
            assertThat(Requests.alarm(Requests.write("r", command)))
                    .isEqualTo(new ParsedRequest.Request<>("r", command));
        }
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '"', textBlock = """
            {'command':'acknowledge'}                           | missing-member
            {'command':'acknowledge','alarm':'a b'}             | illegal-name
            {'command':'mute','for':'PT1H'}                     | missing-member
            {'command':'mute','alarm':'collision-1'}            | missing-member
            {'command':'mute','alarm':'collision-1','for':'1h'} | wrong-member
            {'command':'mute','kind':'fire','for':'PT1H'}       | wrong-member
            {'command':'open','alarm':'collision-1'}            | unknown-command
            {'alarm':'collision-1'}                             | missing-member
            """)
    void answersWhatIsNoRequest(String request, String code) {
        String whole = request.replace("{'", "{'type':'request','").replace('\'', '"');
        ParsedRequest<AlarmCommand> parsedRequest = Requests.alarm(whole.getBytes(StandardCharsets.UTF_8));
        assertThat(parsedRequest)
                .isInstanceOfSatisfying(
                        ParsedRequest.Refused.class,
                        refused -> assertThat(refused.answer().error()).hasValue(code));
    }
}
