package io.furrow.analytics.temperature;

import java.io.IOException;
import java.lang.reflect.Modifier;
import java.nio.file.Path;
import java.util.List;
import java.util.stream.Stream;

import org.apache.flink.api.common.serialization.SerializerConfigImpl;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.java.typeutils.PojoTypeInfo;
import org.junit.jupiter.api.Test;

import io.furrow.analytics.field.Field;
import io.furrow.files.Folders;
import io.furrow.flink.record.TopicRecord;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** What flows between operators or lies in state is a public record; no other record is public. */
class FlowTypesTest {
    @Test
    void needNoGenericSerializer() throws Exception {
        assertThat(publicRecords())
                .contains(Reading.class, FieldReading.class, DeviceReadings.class, DeviceVote.class, TopicRecord.class);
        for (Class<?> type : publicRecords()) {
            if (type != TopicRecord.class) { // which has a serializer of its own
                assertThat(TypeInformation.of(type)).isInstanceOf(PojoTypeInfo.class);
            }
            assertThat(TypeInformation.of(type).createSerializer(withoutGenericTypes()))
                    .isNotNull();
        }
    }

    @Test
    void wouldBeFoundIfOneDid() {
        TypeInformation<Field> withGeometry = TypeInformation.of(Field.class);

        assertThatThrownBy(() -> withGeometry.createSerializer(withoutGenericTypes()))
                .isInstanceOf(UnsupportedOperationException.class)
                .hasMessageContaining("Generic types have been disabled");
    }

    private static SerializerConfigImpl withoutGenericTypes() {
        SerializerConfigImpl config = new SerializerConfigImpl();
        config.setGenericTypes(false);
        return config;
    }

    private static List<Class<?>> publicRecords() throws IOException {
        Path root = Path.of("target/classes");
        Path classes = root.resolve(Reading.class.getPackageName().replace('.', '/'));
        Stream<Class<?>> ours = Folders.walk(classes).stream()
                .map(file -> root.relativize(file).toString())
                .filter(file -> file.endsWith(".class") && !file.endsWith("package-info.class"))
                .map(file -> named(file.replace(".class", "").replace('/', '.')));
        return Stream.concat(ours, Stream.of(TopicRecord.class))
                .filter(type -> type.isRecord() && Modifier.isPublic(type.getModifiers()))
                .toList();
    }

    private static Class<?> named(String name) {
        return Unchecked.get(() -> Class.forName(name, false, FlowTypesTest.class.getClassLoader()));
    }
}
