# SPDX-License-Identifier: BSD-3-Clause
"""
A stand-in for RecipesBase, for tests on machines without it. It defines the parts of `@recipe` and
`@series` that PNPBS uses, with the same names.
"""
module RecipesBase

export @recipe, @series

struct RecipeData
    plotattributes::AbstractDict{Symbol,Any}
    args::Tuple
end

function apply_recipe end
function is_key_supported end

# `key --> value` sets an attribute unless the user has set it; `key := value` always sets it.
replaced(e) = e
function replaced(e::Expr)
    e.head === :(-->) && return :(get!(plotattributes, $(QuoteNode(e.args[1])), $(e.args[2])))
    e.head === :(:=) && return :(plotattributes[$(QuoteNode(e.args[1]))] = $(e.args[2]))
    return Expr(e.head, replaced.(e.args)...)
end

take_option(option) =
    :($(option.args[1]) = pop!(plotattributes, $(QuoteNode(option.args[1])), $(option.args[2])))

macro recipe(definition)
    call, body = definition.args
    arguments = call.args[2:end]
    has_options = arguments[1] isa Expr && arguments[1].head === :parameters
    options = has_options ? popfirst!(arguments).args : []
    return esc(quote
        function RecipesBase.apply_recipe(plotattributes::AbstractDict{Symbol,Any}, $(arguments...))
            $(take_option.(options)...)
            series_list = RecipesBase.RecipeData[]
            last_series = $(replaced(body))
            push!(series_list, RecipesBase.RecipeData(plotattributes, last_series))
        end
    end)
end

macro series(body)
    return esc(quote
        let plotattributes = copy(plotattributes)
            push!(series_list, RecipesBase.RecipeData(plotattributes, $body))
        end
    end)
end

end
