/** Hand-written serializers: compact, with a version for each format that state was ever written in. */
package io.furrow.flink.format;
