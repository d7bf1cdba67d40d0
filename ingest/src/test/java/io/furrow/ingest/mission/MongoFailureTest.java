package io.furrow.ingest.mission;

import java.util.stream.Stream;

import com.mongodb.MongoClientException;
import com.mongodb.MongoCommandException;
import com.mongodb.MongoCredential;
import com.mongodb.MongoException;
import com.mongodb.MongoSecurityException;
import com.mongodb.MongoSocketOpenException;
import com.mongodb.MongoTimeoutException;
import com.mongodb.ServerAddress;
import org.bson.BsonDocument;
import org.bson.BsonInt32;
import org.bson.BsonString;
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
        91    | shutdown in progress                    | AWAY
        189   | primary stepped down                    | AWAY
        10107 | not primary                             | AWAY
        14031 | out of disk space                       | AWAY
        11000 | E11000 duplicate key index: _id_ dup    | AWAY
        11000 | E11000 duplicate key index: serial dup  | REFUSED
        13    | not authorized                          | SETTING
        18    | authentication failed                   | SETTING
        166   | is a view                               | SETTING
        2     | bad value                               | REFUSED
        121   | document failed validation              | REFUSED
        10334 | object too large                        | REFUSED
        """)
    void tellsByTheServersCode(int code, String message, MongoFailure failure) {
        BsonDocument answer = new BsonDocument("code", new BsonInt32(code)).append("errmsg", new BsonString(message));

        assertThat(MongoFailure.of(new MongoCommandException(answer, SERVER))).isEqualTo(failure);
        assertThat(MongoFailure.of(code, message)).isEqualTo(failure);
    }

    static Stream<Arguments> whatTheDriverSays() {
        MongoSocketOpenException refused = new MongoSocketOpenException("refused", SERVER);
        return Stream.of(
                arguments(refused, MongoFailure.AWAY),
                arguments(new MongoTimeoutException("no server"), MongoFailure.AWAY),
                arguments(new MongoClientException("the pool is paused"), MongoFailure.AWAY),
                arguments(new MongoSecurityException(USER, "while it asked", refused), MongoFailure.AWAY),
                arguments(new MongoSecurityException(USER, "wrong password"), MongoFailure.SETTING));
    }

    @ParameterizedTest
    @MethodSource("whatTheDriverSays")
    void takesWhatTheDriverSaysForNoFaultOfADocument(MongoException said, MongoFailure failure) {
        assertThat(MongoFailure.of(said)).isEqualTo(failure);
    }
}
