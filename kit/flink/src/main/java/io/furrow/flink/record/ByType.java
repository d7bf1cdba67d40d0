package io.furrow.flink.record;

import java.io.Serializable;
import java.util.ArrayList;
import java.util.List;
import java.util.function.Function;

import org.apache.flink.api.common.functions.RuntimeContext;
import org.apache.flink.api.common.state.MapState;
import org.apache.flink.api.common.state.MapStateDescriptor;
import org.apache.flink.api.common.state.ValueState;
import org.apache.flink.api.common.state.ValueStateDescriptor;
import org.apache.flink.api.common.typeinfo.TypeInformation;
import org.apache.flink.api.common.typeinfo.Types;

/**
 * Keyed state of the entities that share an id, by their type. Nearly always there is one: it is a value of its own, the others
 * are in a map.
 *
 * @param <T> what is known of an entity
 */
public final class ByType<T> {
    private final ValueState<T> first;
    private final MapState<String, T> others;
    private final Function<T, String> typeOf;

    /** What state is called, and how it names its type. */
    public record Descriptor<T>(String name, Class<T> type, TypeOf<T> typeOf) {
        public ByType<T> of(RuntimeContext context) {
            TypeInformation<T> information = TypeInformation.of(type);
            return new ByType<>(
                    context.getState(new ValueStateDescriptor<>(name, information)),
                    context.getMapState(new MapStateDescriptor<>(name + "-of-other-types", Types.STRING, information)),
                    typeOf);
        }
    }

    /** The entity type of what is known; empty where a deletion did not name it. */
    public interface TypeOf<T> extends Function<T, String>, Serializable {}

    private ByType(ValueState<T> first, MapState<String, T> others, Function<T, String> typeOf) {
        this.first = first;
        this.others = others;
        this.typeOf = typeOf;
    }

    /** Null if nothing is known. */
    public T get(String type) throws Exception {
        T one = first.value();
        return one != null && is(one, type) ? one : others.get(type);
    }

    /** What is known of one type, or of all if the type is empty. */
    public List<T> allOf(String type) throws Exception {
        if (!type.isEmpty()) {
            T one = get(type);
            return one == null ? List.of() : List.of(one);
        }
        List<T> all = new ArrayList<>();
        if (first.value() != null) {
            all.add(first.value());
        }
        others.values().forEach(all::add);
        return all;
    }

    public boolean isEmpty() throws Exception {
        return first.value() == null && others.isEmpty();
    }

    /** Null if nothing is known. */
    public T first() throws Exception {
        return first.value();
    }

    /** @return whether it is not the first of its id */
    public boolean put(String type, T known) throws Exception {
        T one = first.value();
        boolean isOther = one == null ? others.contains(type) : !is(one, type);
        put(!isOther, known);
        return isOther;
    }

    /** As {@link #put} where it is known whether it is the first. */
    public void put(boolean isFirst, T known) throws Exception {
        if (isFirst) {
            first.update(known);
        } else {
            others.put(typeOf.apply(known), known);
        }
    }

    public void remove(T known) throws Exception {
        if (known.equals(first.value())) {
            first.clear();
        } else {
            others.remove(typeOf.apply(known));
        }
    }

    private boolean is(T known, String type) {
        String its = typeOf.apply(known);
        return its.isEmpty() || its.equals(type);
    }
}
