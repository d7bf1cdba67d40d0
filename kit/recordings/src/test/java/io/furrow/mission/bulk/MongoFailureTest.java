package io.furrow.mission.bulk;

import java.util.List;
import java.util.Set;
import java.util.stream.Stream;

import com.mongodb.MongoClientException;
import com.mongodb.MongoCommandException;
import com.mongodb.MongoCredential;
import com.mongodb.MongoException;
import com.mongodb.MongoSecurityException;
import com.mongodb.MongoSocketOpenException;
import com.mongodb.MongoTimeoutException;
import com.mongodb.ServerAddress;
import org.bson.BsonArray;
import org.bson.BsonDocument;
import org.bson.BsonInt32;
import org.bson.BsonString;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.MethodSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.junit.jupiter.params.provider.Arguments.arguments;

class MongoFailureTest {
    private static final ServerAddress SERVER = new ServerAddress("127.0.0.1", 27017);
    private static final MongoCredential USER = MongoCredential.createCredential("u", "admin", new char[0]);

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        91    | shutdown in progress                    | UNAVAILABLE
        189   | primary stepped down                    | UNAVAILABLE
        10107 | not primary                             | UNAVAILABLE
        14031 | out of disk space                       | UNAVAILABLE
        11000 | E11000 duplicate key index: _id_ dup    | UNAVAILABLE
        11000 | E11000 index: persistence.m.$_id_ dup   | UNAVAILABLE
        11000 | E11000 duplicate key index: serial dup  | REJECTED
        11000 | E11000 index: device_id_1 dup           | REJECTED
        13    | not authorized                          | SETTING
        18    | authentication failed                   | SETTING
        166   | is a view                               | SETTING
        365   | temporarily unavailable                 | UNAVAILABLE
        16500 | request rate is large                   | UNAVAILABLE
        13388 | stale config                            | UNAVAILABLE
        150   | stale epoch                             | UNAVAILABLE
        133   | no primary for the read preference      | UNAVAILABLE
        314   | object is busy                          | UNAVAILABLE
        61    | the collection is sharded by another key| SETTING
        1     | internal error                          | UNKNOWN
        8     | unknown error                           | UNKNOWN
        -1    | no code at all                          | UNKNOWN
        777777| a code of a server to come              | UNKNOWN
        2     | bad value                               | REJECTED
        9     | failed to parse                         | REJECTED
        14    | type mismatch                           | REJECTED
        17280 | key too long to index                   | REJECTED
        16755 | can't extract geo keys                  | REJECTED
        121   | document failed validation              | REJECTED
        10334 | object too large                        | REJECTED
        """)
    void classifiesServerCodes(int code, String message, MongoFailure failure) {
        BsonDocument answer = new BsonDocument("code", new BsonInt32(code)).append("errmsg", new BsonString(message));

        assertThat(MongoFailure.of(new MongoCommandException(answer, SERVER))).isEqualTo(failure);
        assertThat(MongoFailure.of(code, message)).isEqualTo(failure);
    }

    @Test
    void classifiesTheLabelOfAnOverloadedServerAsUnavailable() {
        BsonDocument answer = new BsonDocument("code", new BsonInt32(777_777))
                .append("errmsg", new BsonString("shed"))
                .append("errorLabels", new BsonArray(List.of(new BsonString("SystemOverloadedError"))));

        assertThat(MongoFailure.of(new MongoCommandException(answer, SERVER))).isEqualTo(MongoFailure.UNAVAILABLE);
    }

    @Test
    void namesEachCodeOnce() {
        List<Integer> all = Stream.of(MongoCodes.OF_DOCUMENT, MongoCodes.OF_SETTING, MongoCodes.TRANSIENT)
                .flatMap(Set::stream)
                .toList();

        assertThat(all).doesNotHaveDuplicates();
    }

    static Stream<Arguments> driverFailures() {
        MongoSocketOpenException refused = new MongoSocketOpenException("refused", SERVER);
        return Stream.of(
                arguments(refused, MongoFailure.UNAVAILABLE),
                arguments(new MongoTimeoutException("no server"), MongoFailure.UNAVAILABLE),
                arguments(new MongoClientException("the pool is paused"), MongoFailure.UNAVAILABLE),
                arguments(new MongoSecurityException(USER, "while it asked", refused), MongoFailure.UNAVAILABLE),
                arguments(new MongoSecurityException(USER, "wrong password"), MongoFailure.SETTING));
    }

    @ParameterizedTest
    @MethodSource("driverFailures")
    void classifiesFailuresOfTheDriver(MongoException driverFailure, MongoFailure failure) {
        assertThat(MongoFailure.of(driverFailure)).isEqualTo(failure);
    }
}
