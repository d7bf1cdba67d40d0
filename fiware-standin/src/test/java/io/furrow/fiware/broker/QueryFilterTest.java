package io.furrow.fiware.broker;

import java.nio.charset.StandardCharsets;
import java.time.Instant;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.fiware.NgsiError;
import io.furrow.fiware.api.EntityReader;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class QueryFilterTest {
    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '"',
            value = {
                "temperature==21.5        | true",
                "temperature==21.50       | true",
                "temperature:21.5         | true",
                "temperature==21          | false",
                "temperature=='21.5'      | false",
                "temperature!=21          | true",
                "temperature!=21.5        | false",
                "temperature>21           | true",
                "temperature>21.5         | false",
                "temperature>=21.5        | true",
                "temperature<21.5         | false",
                "temperature<=21.5        | true",
                "temperature<-3           | false",
                "temperature==20..22      | true",
                "temperature==22..24      | false",
                "temperature!=22..24      | true",
                "temperature==1,21.5,3    | true",
                "temperature==1,3         | false",
                "name==north field        | true",
                "name=='north field'      | true",
                "name=='a;b','north field'| true",
                "name==south              | false",
                "name!=south              | true",
                "name~=^north             | true",
                "name~=^field             | false",
                "name>21                  | false",
                "on==true                 | true",
                "on==false                | false",
                "place.city==Leon         | true",
                "place.city==Madrid       | false",
                "place.street             | false",
                "tags==b                  | true",
                "tags==c                  | false",
                "temperature              | true",
                "humidity                 | false",
                "!humidity                | true",
                "!temperature             | false",
                "humidity!=3              | false",
                "humidity==3              | false",
                "seen>2026-11-21T01:00:00Z       | true",
                "seen<2026-11-21T01:00:00Z       | false",
                "seen==2026-11-21..2026-11-22    | true",
                "dateModified>=2026-11-21T02:00:00.000Z | true",
                "dateModified>2026-11-21T02:00:00Z      | false",
                "dateModified>2026-11-21T02:59:59+01:00 | true",
                "dateCreated<2026-11-21T00:00:01Z       | true",
                "temperature>20;on==true  | true",
                "temperature>20;on==false | false",
                "temperature>20;!humidity | true",
            })
    void tellsWhetherAnEntityPasses(String q, boolean passes) throws Exception {
        assertThat(QueryFilter.parse(q).test(probe())).isEqualTo(passes);
    }

    @ParameterizedTest
    @ValueSource(strings = {";", "==3", "a==1;;b==2", "temperature=3", "a<1,2", "a>1..2", "a~=(", "!", "a==1;"})
    void refusesWhatIsNoQuery(String q) {
        assertThatThrownBy(() -> QueryFilter.parse(q))
                .isInstanceOf(NgsiError.class)
                .extracting(error -> ((NgsiError) error).status())
                .isEqualTo(400);
    }

    @Test
    void takesASemicolonBetweenQuotesAsText() throws Exception {
        assertThat(QueryFilter.parse("name!='a;b'").test(probe())).isTrue();
    }

    private static StoredEntity probe() throws Exception {
        String json = """
                {"id": "urn:ngsi-ld:SoilProbe:1", "type": "SoilProbe", "temperature": 21.5, "name": "north field", "on": true,
                 "place": {"city": "Leon"}, "tags": ["a", "b"], "seen": "2026-11-21T01:30:00Z"}""";
        EntityUpdate update = new EntityReader(true).entity(NgsiJson.read(json.getBytes(StandardCharsets.UTF_8)));
        StoredEntity entity = Change.create(FiwareScope.DEFAULT, update, Instant.parse("2026-11-21T00:00:00Z"))
                .after();
        return new StoredEntity(
                entity.scope(),
                entity.id(),
                entity.type(),
                entity.attributes(),
                entity.created(),
                Instant.parse("2026-11-21T02:00:00Z"));
    }
}
