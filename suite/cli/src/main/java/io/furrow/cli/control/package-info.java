/** The commands that use the control plane over its REST API. */
package io.furrow.cli.control;
